// What a scene does may not depend on which of its sides is called left, on the name of a horizontal
// direction, on how many threads there are, nor on whether the run was stopped and gone on with. Six scenes,
// each with every preset. (Shifts: verify_periodic; units: verify_units; depth and output: the rows of
// invariance in compare/checks.toml, of the same scenes.)
#include <ostream>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/mapped_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof {
namespace {

using test::expect_same;
using test::Mapping;

constexpr int steps = 12;

struct Choice {
  std::string scene, preset;
};
void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.scene << ", " << choice.preset;
}

Scene small_scene(const Choice& choice, std::vector<std::string> overrides = {}) {
  overrides.push_back("model.preset=" + choice.preset);
  return load_scene(cases_directory() / "invariance" / (choice.scene + ".toml"), overrides);
}

class Invariance : public ::testing::TestWithParam<Choice> {
 protected:
  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }

 private:
  test::TemporaryDirectory directory_;
};

TEST_P(Invariance, MirroredInX) {
  const Scene scene = small_scene(GetParam(), test::tightly_solved);
  // Beds are as wide as the tank, or stand at the left: their box stays, as the slope of a heap does.
  const Mapping map = Mapping::mirror(0);
  Scene mirrored = map(scene);
  mirrored.bed = scene.bed;
  mirrored.liquid_boxes = scene.liquid_boxes;
  expect_same(scene, mirrored, map, steps);
}

// A slice of one cell, without the gate: that rises across x alone.
TEST_P(Invariance, XAndZExchanged) {
  Scene scene = small_scene(GetParam(), test::tightly_solved);
  scene.gate.reset();
  scene.dimensions = 3;
  scene.tank[2] = scene.grid.spacing[2] = scene.grid.spacing[0];
  scene.bed->box.upper[2] = scene.tank[2];
  for (Box& box : scene.liquid_boxes) box.upper[2] = scene.tank[2];
  for (const int side : {front, back})
    scene.sides[side].fluid.kind = scene.sides[side].solid.kind = WallKind::slip;
  const Mapping map = Mapping::exchange(0, 2);
  expect_same(scene, map(scene), map, steps);
}

// To the bit. Stopped at half its length, and gone on with by two threads.
TEST_P(Invariance, ThreadsAndARestart) {
  const Scene whole = small_scene(GetParam(), {"output.field_times=[0]"});
  const double end = 0.5 * whole.times.end / whole.times.unit;
  const Scene half = small_scene(GetParam(), {"time.end=" + std::to_string(end), "output.field_times=[0]"});
  ASSERT_EQ(test::run_into(path("whole"), whole), 0);
  ASSERT_EQ(test::run_into(path("parts"), half), 0);
  EXPECT_NE(test::text_of(path("whole") / "series.csv"), test::text_of(path("parts") / "series.csv"));
  ASSERT_EQ(test::run_into(path("parts"), whole, true, 2), 0);
  EXPECT_EQ(test::text_of(path("whole") / "series.csv"), test::text_of(path("parts") / "series.csv"));
}

std::vector<Choice> all_choices() {
  std::vector<Choice> all;
  for (const char* scene : {"column", "slope", "dry", "piston", "raft", "suspension"})
    for (const char* preset : {"paper", "sourced", "advised"}) all.push_back({scene, preset});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Invariance, ::testing::ValuesIn(all_choices()),
                         [](const auto& c) { return c.param.scene + "_" + c.param.preset; });

}  // namespace
}  // namespace granvof
