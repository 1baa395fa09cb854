// What a scene does may not depend on how many processes share its tank: the scenes of verify_invariance and
// the others of their kind, each with every preset, on two and on three slabs.
#include <filesystem>
#include <ostream>
#include <set>

#include <fmt/format.h>

#include "solver/grid/slabs.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/cut_runs.hpp"

namespace granvof {
namespace {

constexpr int steps = 8;
constexpr int most_processes = 3;

struct Choice {
  std::string scene, preset;
};
void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.scene << ", " << choice.preset;
}

// Narrow ones with columns enough, as high as they are.
Scene wide_enough(const Choice& choice) {
  std::vector<std::string> overrides = test::tightly_solved;
  overrides.push_back("model.preset=" + choice.preset);
  const auto file = cases_directory() / "invariance" / (choice.scene + ".toml");
  const Scene scene = load_scene(file, overrides);
  constexpr int columns = most_processes * least_rows_of_a_slab;
  if (scene.grid.cells[0] >= columns) return scene;
  overrides.push_back(fmt::format("grid.dx={}", scene.tank[0] / columns));
  overrides.push_back(fmt::format("grid.dy={}", scene.grid.spacing[1]));
  return load_scene(file, overrides);
}

class InvarianceOnSlabs : public ::testing::TestWithParam<Choice> {};

TEST_P(InvarianceOnSlabs, TakesTheStepsOfOneProcess) {
  test::expect_the_steps_of_one(wide_enough(GetParam()), {2, most_processes}, steps);
}

std::vector<Choice> all_choices() {
  std::set<std::string> scenes;
  for (const auto& file : std::filesystem::directory_iterator(cases_directory() / "invariance"))
    scenes.insert(file.path().stem().string());
  std::vector<Choice> all;
  for (const std::string& scene : scenes)
    for (const char* preset : {"paper", "sourced", "advised"}) all.push_back({scene, preset});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, InvarianceOnSlabs, ::testing::ValuesIn(all_choices()),
                         [](const auto& c) { return c.param.scene + "_" + c.param.preset; });

}  // namespace
}  // namespace granvof
