// Steps estimated from the scene alone, against those of runs of small scenes that move fast, or not at all.
#include <limits>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "solver/run/time_loop.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof {
namespace {

const std::string slip = "[walls]\nall = \"slip\"\ntop = \"open\"\n";
const std::string water = "[liquid]\ndensity = 1000\nviscosity = 1e-3\n";
const std::string grains = "[solid]\ndensity = 2500\ndiameter = 2e-3\nfriction = 0.4\n";

struct SmallScene {
  std::string name;
  std::string tank;  // its keys, and those of the grid
  std::string more;  // all other tables
};

class EstimatedSteps : public ::testing::TestWithParam<SmallScene> {};
void PrintTo(const SmallScene& scene, std::ostream* out) {
  *out << scene.name;
}

// solver/scene/cost_estimate.hpp says of how many runs.
TEST_P(EstimatedSteps, AreWithinAFactorOfTwoAndAHalf) {
  const auto& [name, tank, more] = GetParam();
  const Scene scene = parse_scene(
      "[scene]\nname = \"" + name + "\"\n[tank]\n" + tank + "[gas]\ndensity = 1\nviscosity = 1e-5\n" + more,
      name + ".toml");
  TimeLoop run(scene);
  double steps = 0.0;
  while (run.now().time < scene.times.end) {
    ASSERT_FALSE(run.advance());
    ++steps;
  }
  const CostEstimate estimate = estimate_cost(scene);
  RecordProperty("ratio", std::to_string(estimate.steps / steps));
  EXPECT_GT(estimate.steps, 0.4 * steps) << steps;
  EXPECT_LT(estimate.steps, 2.5 * steps) << steps;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, EstimatedSteps,
    ::testing::Values(
        SmallScene{"falling_water", "size = [0.2, 2.0]\n[grid]\ndx = 0.02\n",
                   slip + water + "box = { origin = [0.04, 1.7], size = [0.12, 0.2] }\n[time]\nend = 0.8\n"},
        SmallScene{"falling_grains", "size = [0.6, 3.0]\n[grid]\ndx = 0.05\n",
                   slip + grains +
                       "[bed]\nx = 0.2\nlength = 0.2\ny = 2.0\nheight = 0.3\nsolid_fraction = 0.55\n"
                       "[time]\nend = 1.5\n"},
        SmallScene{"dam_break", "size = [2.0, 1.2]\n[grid]\ndx = 0.04\n",
                   slip + water + "box = { origin = [0, 0], size = [0.4, 1.0] }\n[time]\nend = 2\n"},
        SmallScene{"jet_from_above", "size = [0.5, 1.0]\n[grid]\ndx = 0.05\n",
                   "[walls]\nall = \"slip\"\ntop = { inflow = 0.3 }\n"
                   "right = { outflow_pressure = 0, outflow_level = 0 }\n" +
                       water + "level = 0.1\n[time]\nend = 0.7\n"},
        SmallScene{"grains_from_above", "size = [0.2, 1.0]\n[grid]\ndx = 0.02\n",
                   "[walls]\nall = \"slip\"\ntop = { inflow = 0.2, inflow_solid_fraction = 0.1 }\n"
                   "bottom = { outflow_pressure = 0 }\n" +
                       grains + "[time]\nend = 1.5\n"},
        SmallScene{"jet_through_a_slot", "size = [0.4, 0.2]\n[grid]\ndx = 0.02\n",
                   "[obstacle]\nx0 = [0.04]\nx1 = [0.06]\ny0 = [0.04]\ny1 = [0.2]\n"
                   "[walls]\nall = \"slip\"\nleft = { inflow = 2 }\nright = { outflow_pressure = 0 }\n" +
                       water + "level = 0.2\n[time]\nend = 0.3\n"},
        SmallScene{
            "grains_down_a_tilted_tank", "size = [3.0, 0.3]\ninclination = 35\n[grid]\ndx = 0.05\n",
            slip + grains + "[bed]\nlength = 0.4\nheight = 0.1\nsolid_fraction = 0.58\n[time]\nend = 1.5\n"},
        SmallScene{"water_down_a_tilted_tank", "size = [3.0, 0.3]\ninclination = 10\n[grid]\ndx = 0.05\n",
                   slip + water + "box = { origin = [0, 0], size = [0.5, 0.2] }\n[time]\nend = 1.5\n"},
        SmallScene{"tall_column", "size = [1.0, 0.6]\n[grid]\ndx = 0.02\n",
                   slip + grains +
                       "[bed]\nlength = 0.1\nheight = 0.5\nsolid_fraction = 0.58\n[time]\nend = "
                       "0.6\n"},
        SmallScene{"suspension", "size = [0.05, 0.3]\n[grid]\ndx = 0.01\n",
                   slip + water + "level = 0.28\n" + grains +
                       "[bed]\nlength = 0.05\nheight = 0.25\nsolid_fraction = 0.2\n[time]\nend = 4\n"},
        SmallScene{"at_rest", "size = [0.4, 0.12]\n[grid]\ndx = 0.02\n",
                   slip + water + "level = 0.1\n" + grains +
                       "[bed]\nlength = 0.4\nheight = 0.06\nsolid_fraction = 0.58\n[time]\nend = 2\n"}),
    [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace granvof
