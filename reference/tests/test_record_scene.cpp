// One small case from preparation to its run directory.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "reference/demvof/program/record_scene.hpp"
#include "reference/tests/small_case.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

namespace fs = std::filesystem;

struct Recorded {
  int code;
  std::string facts;  // run.json
  granvof::Series series;
};

Recorded recorded(const std::vector<std::string>& overrides) {
  const granvof::test::TemporaryDirectory directory;
  const fs::path& out = directory.path();
  demvof::RecordOptions options;
  options.out = out / "run";
  options.scratch = out / "scratch";
  options.command = "test";
  const int code = demvof::record_scene(demvof::test::small(overrides), options);
  std::ostringstream facts;
  facts << std::ifstream(options.out / "run.json").rdbuf();
  return {code, facts.str(), granvof::read_series(options.out / "series.csv")};
}

}  // namespace

// Grains in air: nothing to lose, so nothing is lost; the column stands or falls as its grains do.
TEST(RecordScene, ACaseWithoutLiquidRuns) {
  const Recorded dry = recorded({"liquid=false"});
  EXPECT_EQ(dry.code, 0);
  EXPECT_NE(dry.facts.find("\"liquid_volume_error\": 0.0"), std::string::npos) << dry.facts;
  const auto change = dry.series.column("liquid_volume_change");
  ASSERT_EQ(change.size(), 6U);
  for (const auto& value : change) EXPECT_EQ(value, 0.0);
  EXPECT_GT(*dry.series.column("u_s_max").back(), 0.02);  // it does fall
  EXPECT_LT(*dry.series.column("u_s_max").back(), 0.5);
}

// The same with water, which is kept.
TEST(RecordScene, ACaseWithLiquidKeepsIt) {
  const Recorded wet = recorded({});
  EXPECT_EQ(wet.code, 0);
  for (const auto& value : wet.series.column("liquid_volume_change")) EXPECT_LT(std::abs(*value), 1e-8);
  EXPECT_GT(*wet.series.column("liquid_volume").back(), 0.0);
}
