// What kind of scene it is, by its dimensionless numbers, and which recorded scenes are near it.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "compare/checks/table.hpp"
#include "compare/study/like_scene.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

const fs::path cases = cases_directory();

Scene shipped(const std::string& name, const std::vector<std::string>& set = {}) {
  return load_scene(cases / (name + ".toml"), set);
}

double number(const SceneNumbers& numbers, std::string_view name) {
  for (const Number& one : numbers.numbers)
    if (one.name == name) return one.value;
  return NAN;
}

TEST(LikeScene, NumbersOfASubmergedColumn) {
  const SceneNumbers s1 = numbers_of(shipped("s1"));
  EXPECT_EQ(s1.surroundings, "submerged");
  EXPECT_DOUBLE_EQ(number(s1, "density ratio"), 2.5);
  EXPECT_NEAR(number(s1, "aspect ratio"), 0.049 / 0.0975, 1e-12);
  EXPECT_NEAR(number(s1, "h/d"), 0.049 / 0.8e-3, 1e-9);
  // sqrt(2500 * 1500 * 9.81 * 0.8e-3^3) / (18e-3)
  EXPECT_NEAR(number(s1, "Stokes number"), std::sqrt(2500.0 * 1500.0 * 9.81 * 5.12e-10) / 18e-3, 1e-9);
}

TEST(LikeScene, SurroundingsAreThoseOfTheGrains) {
  EXPECT_EQ(numbers_of(shipped("dry-column")).surroundings, "dry");
  EXPECT_EQ(numbers_of(shipped("float-full-r04")).surroundings, "floating");
  EXPECT_EQ(numbers_of(shipped("water-entry")).surroundings, "above liquid");
  EXPECT_EQ(numbers_of(shipped("dam-break")).surroundings, "no grains");
  EXPECT_EQ(numbers_of(shipped("s1", {"liquid.level=0.03"})).surroundings, "partly wet");
}

class Like : public testing::Test {
 protected:
  static KnownRow row(const std::string& run, const std::string& metric, double value, double reference,
                      const std::string& kind = "DEM") {
    return {run, metric, kind, value, reference};
  }
  const Table table_ = parse_table(R"toml(
[[run]]
id = "s1"
[[run]]
id = "s1-sourced"
case = "s1"
set = ["model.preset=sourced"]
[[run]]
id = "s2"
[[run]]
id = "dry-column"
[[check]]
run = ["s1", "s1-sourced", "s2", "dry-column"]
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "verify"
)toml",
                                   "checks");
  const std::vector<KnownRow> rows_{
      row("s1", "run_out@2", 0.6, 0.3),          row("s1", "run_out@10", 2.4, 1.8),
      row("s1", "run_out_dense@10", 9.0, 1.0),   row("s1", "run_out@10", 7.0, 1.0, "theory"),
      row("s1-sourced", "run_out@10", 1.9, 2.0), row("s2", "run_out@10", 2.0, 1.0),
      row("dry-column", "run_out@10", 1.0, 2.0)};
  const Scene mine_ = shipped("s1", {"bed.height=0.05"});
};

TEST_F(Like, TheNearestInTheSameSurroundingsComesFirst) {
  Scene mine = mine_;
  mine.name = "mine";
  const Quantity at_the_end = parse_quantity("run_out@10", std::nullopt);
  const auto found = like_scenes(mine, at_the_end, table_, rows_, cases);
  ASSERT_EQ(found.size(), 2u);  // the dry column is none
  EXPECT_EQ(found[0].case_name, "s1");
  EXPECT_LT(found[0].farthest, 1.1);
  EXPECT_GT(found[1].farthest, 1.5);
  ASSERT_EQ(found[0].errors.size(), 2u);
  // Of a metric every instant, by itself: 0.3 / 0.3 and 0.6 / 1.8; of DEM alone.
  EXPECT_NEAR(found[0].errors[0].highest, 1.0, 1e-12);
  EXPECT_NEAR(found[0].errors[0].lowest, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(found[0].errors[0].preset, "paper");
  EXPECT_EQ(found[0].errors[1].preset, "sourced");
  const auto text = likeness_text(numbers_of(mine), found);
  ASSERT_EQ(text.size(), 5u);
  EXPECT_NE(text[1].find("paper 33 to 100 % (s1)"), std::string::npos) << text[1];
  EXPECT_NE(text[2].find("near: each within"), std::string::npos) << text[2];
  EXPECT_NE(text[4].find("NOT near"), std::string::npos) << text[4];
}

TEST_F(Like, OfACurveTheErrorIsItsRms) {
  Scene mine = mine_;
  mine.name = "mine";
  const Quantity curve = parse_quantity("run_out", std::nullopt);
  const auto found = like_scenes(mine, curve, table_, rows_, cases, 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].errors[0].highest, std::sqrt((0.09 + 0.36) / 2.0) / 1.8, 1e-12);
}

TEST_F(Like, ASceneIsNotLikeItselfAndWhatIsNotKnownIsSaid) {
  EXPECT_EQ(
      like_scenes(mine_, parse_quantity("run_out", std::nullopt), table_, rows_, cases).front().case_name,
      "s2");
  const auto none = like_scenes(mine_, parse_quantity("flat_top@10", std::nullopt), table_, rows_, cases);
  EXPECT_TRUE(none.empty());
  EXPECT_NE(likeness_text(numbers_of(mine_), none).front().find("not known"), std::string::npos);
}

TEST(KnownRows, OfDamagedResultsAreRefused) {
  const test::TemporaryDirectory directory;
  const fs::path file = directory.path() / "results.json";
  for (const char* text : {"", "[]", "{\"rows\": 3}", "{\"rows\": [{\"value\": 1, \"reference\": 2}]}"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(read_known_rows(file), std::runtime_error) << text;
  }
  std::ofstream(file) << R"({"results": [{"scene": "s1", "metric": "run_out@2", "reference_kind": "DEM",
    "value": 1, "reference": 2}, {"scene": "s1", "metric": "x", "reference_kind": "DEM", "value": null, "reference": 2}]})";
  ASSERT_EQ(read_known_rows(file).size(), 1u);
}

}  // namespace
}  // namespace granvof::compare
