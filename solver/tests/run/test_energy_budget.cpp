// The energy budget: it closes, its terms are the known ones where theory knows them, and it sees what is
// wrong.
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "solver/closures/elastic_energy.hpp"
#include "solver/run/alarms.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::column_scene;
using test::Simulation;

// Energies and work were computed apart from each other: what they leave is small beside what physics took.
void expect_closed(const EnergyTerms& now, double residual_share) {
  EXPECT_GT(now.physical(), 0.0);
  EXPECT_LT(std::fabs(now.residual), residual_share * now.physical());
}

TEST(EnergyBudget, ClosesWithEveryPartOfTheModel) {
  for (const char* change :
       {"model.drag=true", "model.drag=false", "model.granular_temperature=off",
        "model.granular_temperature=algebraic", "model.dilatancy_pressure=false",
        "model.contact_friction=false", "numerics.solid_flux=limited", "bed.solid_fraction=0.61",
        "walls.bottom.velocity=[0.1, 0]", "walls.all=slip", "liquid.level=0.08"}) {
    SCOPED_TRACE(change);
    Simulation run(column_scene({change}));
    run.until(0.05);
    if (::testing::Test::HasFatalFailure()) return;
    expect_closed(run.now.energy, 1e-3);
    EXPECT_GE(run.now.energy.drag, 0.0);
    EXPECT_GE(run.now.energy.friction, 0.0);
    EXPECT_GE(run.now.energy.viscosity, 0.0);
    EXPECT_GE(run.now.energy.numerical_time, 0.0);
  }
}

// Theta is the mean square of a fluctuation in one direction of three.
TEST(EnergyBudget, GranularEnergyIsThatOfThreeDirections) {
  Simulation run(column_scene({}));
  run.set(run.now.theta, [](double, double) { return 0.02; });
  run.fill_ghosts();
  double grains = 0.0;  // [m3]
  for (int j = 0; j < run.grid.cells.n[1]; ++j)
    for (int i = 0; i < run.grid.cells.n[0]; ++i)
      grains += run.now.f_s[run.cell(i, j)] * run.grid.cell_volume;
  const EnergyTerms stored = EnergyBudget(run.grid, run.scene, run.boundary).stored(run.now);
  EXPECT_NEAR(stored.granular, 0.5 * 3.0 * 2500.0 * 0.02 * grains, 1e-9 * stored.granular);
}

// Shear dilates a dense bed: the contacts gain what friction takes for it by tan(psi), which is a part of all
// it takes.
TEST(EnergyBudget, ClosesWithShearDilatancy) {
  Simulation run(column_scene({"model.shear_dilatancy=true", "bed.solid_fraction=0.61"}));
  run.until(0.1);
  if (::testing::Test::HasFatalFailure()) return;
  const EnergyTerms& now = run.now.energy;
  expect_closed(now, 1e-3);
  EXPECT_GT(now.shear_dilatancy, 0.01 * now.friction);
  EXPECT_LT(now.shear_dilatancy, 0.5 * now.friction);
}

// So it is in a step that is long for the bed's contacts, and what they would have held had no grain moved is
// not said to be destroyed.
TEST(EnergyBudget, ALongFirstStepUnderShearDilatancyDestroysNothing) {
  for (const char* place : {"bed.y=0", "bed.y=0.04"}) {
    SCOPED_TRACE(place);
    Simulation run(column_scene({"model.preset=sourced", "tank.size=[0.16, 0.12]", "liquid=false",
                                 "gate=false", "bed.length=0.02", "bed.height=0.06",
                                 "bed.solid_fraction=0.625", place, "numerics.dt_max=0.05"}));
    run.advance();
    if (::testing::Test::HasFatalFailure()) return;
    const EnergyTerms& now = run.now.energy;
    const bool rubs = std::string_view(place) == "bed.y=0";  // one that hangs has nothing to rub on yet
    EXPECT_TRUE(!rubs || now.shear_dilatancy < 0.5 * now.friction);
    EXPECT_LT(energy_destroyed(run.scene, now), 0.5);
  }
}

TEST(EnergyBudget, ClosesInThreeDimensions) {
  constexpr std::string_view cube = R"([scene]
name = "cube"
dimensions = 3
[tank]
size = [0.08, 0.06, 0.04]
[grid]
dx = 0.01
[walls]
top = "open"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.05
[solid]
density = 2500
diameter = 0.8e-3
friction = 0.4
[bed]
length = 0.04
height = 0.03
solid_fraction = 0.57
[model]
preset = "paper"
[time]
end = 0.1
[output]
series_interval = 0.1
)";
  const std::vector<std::string> periodic{"walls.front=periodic", "walls.back=periodic"};
  Simulation run(parse_scene(cube, "cube.toml", periodic));
  run.until(0.04);
  expect_closed(run.now.energy, 1e-3);
}

TEST(EnergyBudget, WhatIsSwitchedOffTakesNothing) {
  Simulation dragless(column_scene({"model.drag=false"})),
      cold(column_scene({"model.granular_temperature=off"}));
  dragless.until(0.02);
  cold.until(0.02);
  EXPECT_EQ(dragless.now.energy.drag, 0.0);
  EXPECT_GT(dragless.now.energy.friction, 0.0);
  EXPECT_EQ(cold.now.energy.collisions, 0.0);
  EXPECT_EQ(cold.now.energy.granular, 0.0);
  EXPECT_NEAR(cold.now.energy.dense_excess, 0.0, 1e-4 * cold.now.energy.drag);
}

// A dense bed that a step sets free: every face that it opens must carry the bed's own fraction (with that of
// the empty side nothing leaves, nothing resists, and the grains got 100 m/s), and grains that lock again in
// the next step must be solved for (P_s^E n gives 1e10 Pa s).
TEST(EnergyBudget, ADenseStartIsGivenNoMoreEnergyThanItsContactsHold) {
  Simulation run(column_scene({"bed.solid_fraction=0.61"}));
  const EnergyTerms start = run.now.energy;
  for (int i = 0; i < 10; ++i) {
    run.advance(5e-4);
    const EnergyTerms& now = run.now.energy;
    EXPECT_LT(now.kinetic, start.elastic) << i;
    EXPECT_LT(std::fabs(now.residual), 1e-2 * start.elastic) << i;
  }
}

// Upwind volume transport makes energy where heavy lies below light, as in a bed. It is an error of the
// discretisation, not of the budget: half the cell, half of it.
TEST(EnergyBudget, WhatVolumeTransportMakesVanishesWithTheCell) {
  std::vector<double> made;
  for (const char* cell : {"grid.dx=0.01", "grid.dx=0.005", "grid.dx=0.0025"}) {
    Simulation run(column_scene({cell, "numerics.cfl=0.4", "numerics.volume_tolerance=1e-8"}));
    run.until(0.1);
    made.push_back(-run.now.energy.numerical_solid);
  }
  EXPECT_GT(made[2], 0.0);
  EXPECT_GT(made[0] / made[1], 1.5);
  EXPECT_GT(made[1] / made[2], 1.5);
  EXPECT_LT(made[1] / made[2], 3.0);
}

// A liquid that a uniform flow carries along, with a shear wave across it: the upwind difference is a
// viscosity U h / 2, and all that the wave loses in steps too short to matter is what it takes.
double taken_from_a_wave(int cells, double* predicted) {
  constexpr double speed = 0.2, amplitude = 0.02, length = 0.16, wave = 2.0 * std::numbers::pi / length;
  Simulation run(parse_scene(fmt::format(R"([scene]
name = "wave"
dimensions = 2
[tank]
size = [0.16, 0.04]
gravity = 0
[grid]
dx = {}
dy = 0.02
[walls]
all = "slip"
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[gas]
density = 1000
viscosity = 0
[model]
preset = "paper"
les = false
[time]
end = 1
[output]
series_interval = 1
)",
                                         length / cells),
                             "wave.toml", {}));
  run.now.u_c[0].fill(speed);
  run.set_faces(run.now.u_c[1], 1, [=](double x, double) { return amplitude * std::sin(wave * x); });
  run.fill_ghosts();
  constexpr double dt = 1e-4, steps = 10;
  for (int i = 0; i < steps; ++i) run.advance(dt);
  const double mean_square_slope = 0.5 * amplitude * amplitude * wave * wave;
  *predicted = 1000.0 * 0.5 * speed * run.grid.h[0] * mean_square_slope * (length * 0.04) * steps * dt;
  const EnergyTerms& e = run.now.energy;
  EXPECT_NEAR(e.numerical_momentum, e.upwind_momentum, 0.02 * e.upwind_momentum);
  return e.upwind_momentum;
}

TEST(EnergyBudget, UpwindMomentumTakesWhatItsViscosityPredicts) {
  double of_coarse = 0.0, of_fine = 0.0;
  const double coarse = taken_from_a_wave(32, &of_coarse), fine = taken_from_a_wave(64, &of_fine);
  EXPECT_NEAR(coarse, of_coarse, 0.02 * of_coarse);
  EXPECT_NEAR(fine, of_fine, 0.005 * of_fine);
}

// Grains too small to settle are lifted with the water, above them none: |u| h / 2 times the jump of f_s
// spreads them upwards, against their weight in the mixture.
TEST(EnergyBudget, UpwindGrainsAreLiftedAsTheirDiffusionPredicts) {
  for (const char* cell : {"0.01", "0.005"}) {
    constexpr double speed = 0.02, fraction = 0.1, dt = 1e-4;
    Simulation run(
        test::small_tank("lift", "size = [0.02, 0.2]", 0.2,
                         fmt::format(R"([bed]
length = 0.02
height = 0.04
solid_fraction = 0.5
[walls]
all = "slip"
bottom = {{ inflow = {} }}
top = {{ outflow_pressure = 0 }}
[model]
preset = "paper"
granular_temperature = "off"
[numerics]
volume_tolerance = 1e-10
)",
                                     speed),
                         {"grid.dx=0.01", fmt::format("grid.dy={}", cell), "solid.diameter=1e-5"}));
    run.set(run.now.f_s, [](double, double y) { return y < 0.1 ? fraction : 0.0; });
    run.now.u_s[1].fill(speed);
    run.now.u_c[1].fill(speed);
    run.fill_ghosts();
    run.advance(dt);
    ASSERT_FALSE(HasFatalFailure());
    const double lighter = 1500.0 * (1.0 - 0.5 * fraction);  // the face's mixture than grains [kg/m3]
    const double made = 0.5 * speed * run.grid.h[1] * fraction * lighter * 9.81 * 0.02 * dt;
    EXPECT_NEAR(-run.now.energy.numerical_solid, made, 0.01 * made) << cell;
  }
}

// A solver that does not reach its tolerance leaves momentum or continuity unsolved: that is the residual.
TEST(EnergyBudget, ResidualFollowsTheTolerance) {
  double last = 0.0;
  for (const char* tolerance : {"1e-8", "1e-5", "1e-2"}) {
    Simulation run(column_scene(
        {std::string("numerics.volume_tolerance=") + tolerance, "numerics.linear_tolerance=0.1"}));
    run.until(0.05);
    const double residual = std::fabs(run.now.energy.residual);
    EXPECT_GT(residual, 4.0 * last) << tolerance;  // the loosest leaves what one solve does
    last = residual;
  }
}

// Plane Couette flow of a liquid: what the moving lid gives is what viscosity takes.
TEST(EnergyBudget, MovingWallGivesWhatViscosityTakes) {
  constexpr std::string_view couette = R"([scene]
name = "couette"
dimensions = 2
[tank]
size = [0.04, 0.01]
gravity = 0
[grid]
dx = 0.005
dy = 0.001
[walls]
all = "no-slip"
left = "periodic"
right = "periodic"
top = { velocity = [0.02, 0] }
[gas]
density = 1000
viscosity = 0.1
[model]
preset = "paper"
les = false
[time]
end = 5
[output]
series_interval = 5
)";
  Simulation run(parse_scene(couette, "couette.toml", {}));
  run.until(4.0);
  const EnergyTerms before = run.now.energy;
  run.until(5.0);
  const EnergyTerms& now = run.now.energy;
  const double power = 0.1 * 0.02 * 0.02 / 0.01 * 0.04;  // mu (U / H)^2 H L, depth 1 m
  EXPECT_NEAR(now.walls - before.walls, power, 1e-3 * power);
  EXPECT_NEAR(now.viscosity - before.viscosity, power, 1e-3 * power);
  EXPECT_NEAR(now.kinetic - before.kinetic, 0.0, 1e-6 * power);
}

// Stored by (13): P = f dE/df - E, wherever the grains touch.
TEST(EnergyBudget, ElasticEnergyIsTheIntegralOfItsPressure) {
  const Contact contact;
  const closures::ElasticEnergy energy(contact);
  for (const double packing : {contact.solid_fraction_min, 0.59, 0.62}) {
    EXPECT_EQ(energy(0.5, packing), 0.0);
    EXPECT_EQ(energy(packing, packing), 0.0);
    for (const double excess : {0.004, 0.01, 0.03, 0.04, 0.055, 0.07, 0.09}) {
      const double f = packing + excess, step = 1e-5;
      const double slope = (energy(f + step, packing) - energy(f - step, packing)) / (2.0 * step);
      const double pressure = closures::elastic_pressure(f, contact, packing).value;
      EXPECT_NEAR(f * slope - energy(f, packing), pressure, 2e-4 * pressure) << f << " " << packing;
      const double given = energy.by_packing(f, packing),
                   gain = (energy(f, packing) - energy(f, packing + step)) / step;
      EXPECT_NEAR(given, gain, (excess * excess / (f * f) + 3.0 * step / excess) * given)
          << f << " " << packing;
    }
  }
}

}  // namespace
}  // namespace granvof
