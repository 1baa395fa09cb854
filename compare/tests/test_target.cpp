// References of a study: what a record costs and how uncertain it is.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/input/bands.hpp"
#include "compare/study/target.hpp"
#include "compare/tests/files_stated.hpp"
#include "solver/output/output_error.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* bands = R"([
 {"scene": "canary", "against": "seed2", "column": "front_dense [m]", "rms": 0.003},
 {"scene": "canary", "against": "cell-3.3mm", "column": "front_dense [m]", "rms": 0.002},
 {"scene": "canary", "against": "cell-2mm", "column": "front_dense [m]", "rms": 0.004},
 {"scene": "canary", "against": "smooth-floor", "column": "front_dense [m]", "rms": 1.0}])";

class Records : public testing::Test {
 protected:
  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  // A front that runs `reach` from 0.03 m within 0.2 s.
  void record(const std::string& directory, double reach) {
    const std::string series = "time [s],front_dense [m]\n0,0.03\n0.1," + std::to_string(0.03 + 0.5 * reach) +
                               "\n0.2," + std::to_string(0.03 + reach) + "\n";
    const nlohmann::json json{{"case_hash", scene_.reference_hash},
                              {"core_seconds", 50},
                              {"monitors", {{"preparation_core_seconds", 15}}},
                              {"files", test::files_stated(series)}};
    write(directory + "/record.json", json.dump());
    write(directory + "/series.csv", series);
  }
  const test::TemporaryDirectory directory_;
  const fs::path& root_ = directory_.path();
  const Scene scene_ = load_scene(cases_directory() / "canary.toml");
};

TEST_F(Records, BandsOfSeedGridAndSliceAreTakenTogether) {
  EXPECT_TRUE(read_bands(root_).empty());
  write("bands.json", bands);
  const Bands read = read_bands(root_);
  EXPECT_NEAR(read.of("canary", "front_dense [m]").value(), 0.005, 1e-15);
  EXPECT_FALSE(read.of("canary", "p_base [Pa]"));
  write("bands.json", "{}");
  EXPECT_THROW(read_bands(root_), OutputError);
  for (const char* damaged :
       {"", "[]", "[1]", R"([{"against": "seed2", "column": "p_base [Pa]"}])",
        R"([{"scene": "canary", "against": "seed2", "column": "p_base [Pa]", "rms": "1"}])",
        R"([{"scene": "canary", "against": "seed2", "column": "p_base [Pa]", "rms": -1}])",
        R"([{"scene": "canary", "against": 2, "column": "p_base [Pa]", "rms": 1}])"}) {
    write("bands.json", damaged);
    EXPECT_THROW(read_bands(root_), OutputError) << damaged;
  }
  fs::remove(root_ / "bands.json");
  fs::create_directory(root_ / "bands.json");
  EXPECT_THROW(read_bands(root_), OutputError);
}

// The seeds of s1 say nothing of the canary's, which has seeds of its own; of a scene without they do.
TEST(Bands, OwnDifferencesBeforeThoseOfOtherScenes) {
  Bands measured;
  measured.add("canary", "front", Bands::Kind::seed, 3.0);
  measured.add("canary", "front", Bands::Kind::grid, 4.0);
  measured.add("s1", "front", Bands::Kind::seed, 12.0);
  measured.add("s1", "front", Bands::Kind::seed, 5.0);
  EXPECT_DOUBLE_EQ(measured.of("canary", "front").value(), 5.0);
  EXPECT_DOUBLE_EQ(measured.of("s1", "front").value(), std::sqrt(12.0 * 12.0 + 16.0));
  EXPECT_DOUBLE_EQ(measured.of("water-entry", "front").value(), std::sqrt(12.0 * 12.0 + 16.0));
}

TEST_F(Records, OneRecordIsAsUncertainAsTheCanary) {
  record("canary/seed1", 0.05);
  const Quantity front = parse_quantity("front", std::nullopt);
  EXPECT_EQ(dem_target(front, scene_, root_, "canary").floor, 0.0);
  write("bands.json", bands);
  const Target target = dem_target(front, scene_, root_, "canary");
  EXPECT_NEAR(target.floor, 0.005 / 0.05, 1e-12);
  // The paper's run-out is the same front over h0.
  EXPECT_NEAR(dem_target(parse_quantity("run_out_dense", std::nullopt), scene_, root_, "canary").floor,
              0.005 / 0.05, 1e-12);
}

TEST_F(Records, HalfTheSpreadOfSeedsWhereItIsLarger) {
  record("canary/seed1", 0.05);
  record("canary/seed2", 0.09);
  write("bands.json", bands);
  const Target target = dem_target(parse_quantity("front", std::nullopt), scene_, root_, "canary");
  EXPECT_GT(target.floor, 0.12);
  EXPECT_LT(target.floor, 0.14);
  EXPECT_NE(target.source.find("2 records"), std::string::npos);
}

// core_seconds is of the whole program, the preparation of the beads included.
TEST_F(Records, PreparationCountsOnce) {
  record("canary/seed1", 0.05);
  const Target target = dem_target(parse_quantity("front", std::nullopt), scene_, root_, "canary");
  ASSERT_TRUE(target.cost);
  EXPECT_NEAR(*target.cost, 50.0 / 0.2, 1e-9);
}

TEST_F(Records, ARecordWithoutVariantsIsRead) {
  record("peers/parcels/canary", 0.05);
  const Target target =
      dem_target(parse_quantity("front", std::nullopt), scene_, root_ / "peers/parcels", "canary");
  EXPECT_TRUE(target.observed.defined()) << target.note;
}

}  // namespace
}  // namespace granvof::compare
