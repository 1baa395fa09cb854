// What a scene does may not depend on how many processes share its tank: the scenes of verify_invariance and
// the others of their kind, each with every preset, on two and on three slabs.
#include <filesystem>
#include <ostream>
#include <set>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/cut_runs.hpp"
#include "solver/tests/run/mapped_runs.hpp"

namespace granvof {
namespace {

constexpr int steps = 8;

struct Choice {
  std::string scene, preset;
};
void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.scene << ", " << choice.preset;
}

class InvarianceOnSlabs : public ::testing::TestWithParam<Choice> {};

TEST_P(InvarianceOnSlabs, TakesTheStepsOfOneProcess) {
  const auto& [name, preset] = GetParam();
  std::vector<std::string> overrides = test::tightly_solved;
  overrides.push_back("model.preset=" + preset);
  const Scene scene = load_scene(cases_directory() / "invariance" / (name + ".toml"), overrides);
  test::expect_the_steps_of_one(scene, {2, 3}, steps);
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
