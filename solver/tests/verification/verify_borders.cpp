// The borders of the stability map (compare/stability.toml), a test on both sides of each: what holds ends
// with the warnings named here, most with none; what fails is seen, by the monitor named here.
#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solver/run/run_case.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/output/samples.hpp"

namespace granvof {
namespace {

nlohmann::json record_of(const std::string& scene, const std::vector<std::string>& overrides) {
  const test::TemporaryDirectory directory;
  RunOptions options;
  options.out = directory.path() / "run";
  options.command = "test";
  options.progress = false;
  run_case(load_scene(cases_directory().string() + "/border/" + scene + ".toml", overrides), options);
  std::ifstream file(options.out / "run.json");
  return nlohmann::json::parse(file);
}

struct Point {
  const char* scene;
  std::vector<std::string> overrides;
  std::set<std::string> warns = {};  // the monitors that rightly do, these and no other
};

class Holds : public ::testing::TestWithParam<Point> {};

TEST_P(Holds, EndsAndWarnsOfNothingElse) {
  const nlohmann::json record = record_of(GetParam().scene, GetParam().overrides);
  EXPECT_EQ(record["exit"]["state"], "finished") << record["exit"]["reason"];
  std::set<std::string> warned;
  for (const auto& warning : record["warnings"]) warned.insert(warning["monitor"]);
  EXPECT_EQ(warned, GetParam().warns);
}

// The ends of every axis along which nothing failed, and the near side of the borders. Fluxes of first order
// on so few cells make, at some of them, as much as the flow was given; of a bed that springs apart numerics
// take most.
INSTANTIATE_TEST_SUITE_P(
    Borders, Holds,
    ::testing::Values(
        Point{"collapse", {}}, Point{"float", {}}, Point{"slosh", {}},
        Point{"collapse", {"numerics.cfl=0.9", "numerics.dt_max=0.3"}},
        Point{"float", {"numerics.cfl=0.9", "numerics.dt_max=0.3"}, {"energy created"}},
        Point{"slosh", {"liquid.viscosity=1e-6"}}, Point{"slosh", {"liquid.viscosity=100"}},
        Point{"collapse", {"bed.solid_fraction=0.585"}, {"elastic start", "energy destroyed"}},
        Point{"collapse", {"bed.solid_fraction=0.629"}, {"elastic start", "energy destroyed"}},
        Point{"collapse",
              {"bed.solid_fraction=0.629", "solid.friction=0"},
              {"elastic start", "energy destroyed"}},
        Point{"collapse",
              {"bed.solid_fraction=0.61", "solid.friction=0"},
              {"elastic start", "energy destroyed"}},
        Point{"collapse", {"bed.solid_fraction=1e-7"}}, Point{"collapse", {"gas.density=0.1"}},
        Point{"collapse", {"gas.density=1000"}}, Point{"slosh", {"gas.density=0.1"}},
        Point{"float", {"solid.density=50"}, {"energy created"}}, Point{"float", {"solid.density=950"}},
        Point{"collapse", {"solid.density=1400"}, {"energy created"}},
        Point{"collapse", {"solid.density=20000"}, {"energy created"}},
        Point{"collapse", {"solid.diameter=2e-4"}}, Point{"collapse", {"solid.diameter=5e-3"}},
        Point{"float", {"solid.diameter=5e-5"}}, Point{"collapse", {"contact.stiffness=1e4"}},
        Point{"collapse", {"contact.stiffness=1e12"}}, Point{"collapse", {"contact.regularisation=1e-2"}},
        Point{"collapse", {"contact.regularisation=1e9"}}, Point{"collapse", {"solid.restitution=0"}},
        Point{"collapse", {"solid.restitution=1"}}, Point{"collapse", {"solid.friction=0"}},
        Point{"collapse", {"solid.friction=1.5"}, {"energy created"}},
        Point{"collapse", {"bed.height=0.005"}, {"energy created"}}));

struct Wrong {
  const char* scene;
  std::vector<std::string> overrides;
  const char* monitor;
};

class Fails : public ::testing::TestWithParam<Wrong> {};

TEST_P(Fails, IsSeenByItsMonitor) {
  const nlohmann::json record = record_of(GetParam().scene, GetParam().overrides);
  const auto& warnings = record["warnings"];
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const auto& w) {
    return w["monitor"] == GetParam().monitor;
  })) << warnings;
}

// With grains that hardly sink what first-order transport lifts is more than what drag takes.
INSTANTIATE_TEST_SUITE_P(
    Borders, Fails,
    ::testing::Values(
        Wrong{"collapse", {"solid.density=1050", "numerics.volume_tolerance=1e-9"}, "energy created"},
        // contacts so soft that the bed's weight presses them beyond f_s,max
        Wrong{"collapse", {"contact.stiffness=1e3"}, "solid fraction"},
        // With the second-order flux such a bed ends where the step has it.
        Wrong{"collapse", {"bed.solid_fraction=0.61", "numerics.solid_flux=limited"}, "elastic start"}));

// Little energy is turned over here, and the pressure is solved for it whatever the tolerance.
INSTANTIATE_TEST_SUITE_P(Tolerance, Holds,
                         ::testing::Values(Point{"collapse", {"solid.diameter=5e-5"}},
                                           Point{"collapse",
                                                 {"solid.diameter=5e-5", "numerics.volume_tolerance=1e-3"}}));

}  // namespace
}  // namespace granvof
