// Sums and largest values are those of all processes: in a world that is twice the tank every sum is twice
// that of the tank, and processes with different tanks take the same steps.
//
// A process of either world has a whole tank of its own: nothing passes between them but what they reduce.
#include <gtest/gtest.h>

#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using test::Variant;

constexpr int steps = 6;

Scene scene_of(const Variant& variant, std::vector<std::string> more = {}) {
  std::vector<std::string> overrides = variant.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  return test::column_scene(overrides);
}

// Fields of the state, ghosts included; sums over the tank, and what they are compared with.
struct Outcome {
  std::map<std::string, std::vector<double>> fields;
  std::map<std::string, double> sums, others;
};

Outcome after_steps(const Scene& scene, const Communicator* communicator) {
  TimeLoop loop(scene, communicator);
  Outcome all;
  for (int n = 0; n < steps; ++n) {
    const auto stuck = loop.advance();
    if (stuck) throw std::runtime_error(stuck->reason);
    const StepReport& step = loop.last_step();
    const std::string at = fmt::format(" of step {}", n);
    all.others["dt" + at] = loop.last_dt();
    all.others["newton" + at] = step.pressure.newton;
    all.others["linear" + at] = step.pressure.linear;
    all.others["mismatch" + at] = step.pressure.mismatch;
    all.others["divergence" + at] = step.pressure.divergence;
    all.others["friction" + at] = step.friction.iterations;
    all.others["friction residual" + at] = step.friction.final;
    all.sums["liquid left" + at] = step.liquid_left;
    all.sums["solid left" + at] = step.solid_left;
    for (const EnergyTerm& term : energy_terms) all.sums[term.name + at] = loop.now().energy.*term.value;
  }
  const Monitors::Values monitors = loop.monitors().values();
  all.sums["solid volume"] = monitors.solid_volume;
  all.sums["liquid volume"] = monitors.liquid_volume;
  all.others["solid error"] = monitors.solid_error;
  all.others["liquid error"] = monitors.liquid_error;
  all.others["densest"] = monitors.solid_max;
  all.others["loosest"] = monitors.solid_min;
  const CheckpointView view = loop.checkpoint({});
  for (const auto& [name, values] : view.arrays) all.fields[name].assign(values.begin(), values.end());
  return all;
}

class Processes : public ::testing::TestWithParam<Variant> {};

TEST_P(Processes, BesideATwinEverySumIsTwiceAsLarge) {
  const Scene scene = scene_of(GetParam());
  const test::Twin twin;
  const Outcome alone = after_steps(scene, nullptr), beside = after_steps(scene, &twin);
  for (const auto& [name, values] : alone.fields) EXPECT_EQ(values, beside.fields.at(name)) << name;
  EXPECT_EQ(alone.others, beside.others);
  for (const auto& [name, sum] : alone.sums) EXPECT_EQ(2.0 * sum, beside.sums.at(name)) << name;
  EXPECT_GT(alone.sums.at("energy_kinetic of step 5"), 0.0);
}

TEST_P(Processes, WithDifferentTanksTakeTheSameSteps) {
  const std::array<Scene, 2> scenes{scene_of(GetParam()),
                                    scene_of(GetParam(), {"bed.length=0.1", "liquid.level=0.05"})};
  std::array<Outcome, 2> outcome;
  test::Team team(2);
  ASSERT_NO_THROW(team.run([&](int number, const Communicator& communicator) {
    const auto n = static_cast<std::size_t>(number);
    outcome[n] = after_steps(scenes[n], &communicator);
  }));
  EXPECT_GT(team.meetings(), 50 * steps);
  EXPECT_EQ(outcome[0].others, outcome[1].others);
  EXPECT_EQ(outcome[0].sums, outcome[1].sums);
  EXPECT_NE(outcome[0].fields, outcome[1].fields);
}

// Between them they use every operator that adds up or compares.
INSTANTIATE_TEST_SUITE_P(
    Scenes, Processes,
    ::testing::Values(
        Variant{"paper", {}}, Variant{"sourced", {"model.preset=sourced"}},
        Variant{"advised", {"model.preset=advised"}},
        Variant{"plic_under_a_lid", {"walls.top=no-slip", "numerics.interface_scheme=plic", "gate=false"}},
        Variant{"moving_bumpy_floor_in_periodic_ends",
                {"gate=false", "walls.left=periodic", "walls.right=periodic", "walls.bottom.solid=bumpy",
                 "walls.bottom.bumpiness=36", "walls.bottom.velocity=[0.1, 0]"}},
        Variant{"obstacle_on_a_slope",
                {"obstacle.x0=[0.12]", "obstacle.x1=[0.14]", "obstacle.y0=[0]", "obstacle.y1=[0.02]",
                 "tank.inclination=10"}},
        Variant{"honey_between_inlet_and_outlet",
                {"gate=false", "walls.top=slip", "walls.left.inflow=0.1", "walls.right.outflow_pressure=0",
                 "walls.right.outflow_level=0.06", "liquid.viscosity=2"}},
        Variant{"explicit_contacts", {"numerics.contact_pressure=explicit"}}),
    test::name_of);

}  // namespace
}  // namespace granvof
