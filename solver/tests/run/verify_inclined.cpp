// An inclined tank: gravity has a component along its floor.
#include <cmath>
#include <numbers>

#include "solver/run/alarms.hpp"
#include "solver/scene/gravity.hpp"
#include "solver/tests/level_surface.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::name_of;
using test::Simulation;
using test::Variant;

Scene tank(const std::vector<std::string>& overrides) {
  return test::small_tank("inclined", "size = [0.08, 0.06]\ninclination = 25", 0.06, test::tight_tolerances,
                          overrides);
}

// rho (g_x (x - L/2) + g_y (y - H)), zero in the mean over the lid.
double hydrostatic(const Scene& s, double density, double x, double y) {
  const Vec3 g = gravity_of(s);
  return density * (g[0] * (x - 0.5 * s.tank[0]) + g[1] * (y - s.tank[1]));
}

// Largest distance of P_c from it, over the largest of its values.
double pressure_error(const Simulation& run, double density) {
  const Layout& l = run.grid.cells;
  double error = 0.0, largest = 0.0;
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) {
        const double p =
            hydrostatic(run.scene, density, (i + 0.5) * run.grid.h[0], (j + 0.5) * run.grid.h[1]);
        error = std::fmax(error, std::fabs(run.now.p_c[l.index(i, j, k)] - p));
        largest = std::fmax(largest, std::fabs(p));
      }
  return error / largest;
}

class OneFluid : public ::testing::TestWithParam<Variant> {};

// It starts in the pressure that theory has and keeps it, and finds it from none at all.
TEST_P(OneFluid, StandsInHydrostaticPressure) {
  for (const bool from_nothing : {false, true}) {
    Simulation run(tank(GetParam().overrides));
    const bool gas = run.scene.liquid_boxes.empty();
    const double density = gas ? run.scene.gas.density : run.scene.liquid.density;
    const double wave = std::sqrt(run.scene.gravity * run.scene.tank[1]);
    if (from_nothing) {
      run.now.p_c.fill(0.0);
      run.fill_ghosts();
    } else {
      EXPECT_LT(pressure_error(run, density), 1e-13);
    }
    for (int i = 0; i < 20; ++i) {
      run.advance();
      if (HasFatalFailure()) return;
    }
    EXPECT_LT(pressure_error(run, density), 1e-9) << from_nothing;
    EXPECT_LT(run.fastest(run.now.u_c), 1e-10 * wave) << from_nothing;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tanks, OneFluid,
    ::testing::Values(Variant{"closed", {}}, Variant{"steep", {"tank.inclination=80"}},
                      Variant{"down_to_the_left", {"tank.inclination=-25"}},
                      Variant{"gas_under_an_open_top", {"liquid=false", "walls.top=open"}},
                      Variant{"in_3d", {"scene.dimensions=3", "tank.size=[0.08, 0.06, 0.02]"}}),
    name_of);

// Liquid down a plane, the lid a surface without stress: u(y) = rho g sin(theta) / mu (H y - y^2 / 2). The
// second difference of a parabola is exact; the mirrored ghost of the floor shifts all of it by f h^2 / (8
// mu).
TEST(Film, HasTheProfileOfNusselt) {
  Simulation run(tank({"tank.size=[0.02, 0.02]", "grid.dx=0.0025", "liquid.level=0.02", "liquid.viscosity=1",
                       "walls.left=periodic", "walls.right=periodic", "walls.top=slip", "model.les=false",
                       "tank.inclination=10"}));
  run.until(2.0);
  ASSERT_FALSE(HasFatalFailure());
  const double force = run.scene.liquid.density * gravity_of(run.scene)[0], mu = run.scene.liquid.viscosity;
  const double h = run.grid.h[1], depth = run.scene.tank[1];
  double largest = 0.0;
  for (int j = 0; j < run.grid.cells.n[1]; ++j) {
    const double y = (j + 0.5) * h, u = run.now.u_c[0][run.cell(1, j)];
    largest = std::fmax(largest, std::fabs(u - force / mu * (depth * y - 0.5 * y * y)));
  }
  EXPECT_LT(largest, 0.13 * force * h * h / mu);
  EXPECT_GT(run.now.u_c[0][run.cell(1, 7)], 0.3);
  // Across the film the pressure is that of rest.
  const double across = run.now.p_c[run.cell(1, 0)] - run.now.p_c[run.cell(1, 7)];
  EXPECT_NEAR(across, run.scene.liquid.density * normal_gravity(run.scene) * 7 * h, 1e-6 * across);
}

// What gravity gives along the periodic direction comes from outside: in the steady film viscosity takes it.
TEST(Film, IsDrivenFromOutside) {
  Simulation run(tank({"tank.size=[0.02, 0.02]", "grid.dx=0.0025", "liquid.level=0.02", "liquid.viscosity=1",
                       "walls.left=periodic", "walls.right=periodic", "walls.top=slip", "model.les=false",
                       "tank.inclination=10"}));
  run.until(2.0);
  const EnergyTerms before = run.now.energy;
  run.until(2.5);
  ASSERT_FALSE(HasFatalFailure());
  const double given = before.outflow - run.now.energy.outflow;
  const double spent = run.now.energy.viscosity - before.viscosity;
  // rho^2 g^2 sin^2 H^3 / (3 mu) per area and time
  const double f = run.scene.liquid.density * gravity_of(run.scene)[0], depth = run.scene.tank[1];
  const double theory = f * f * depth * depth * depth / (3.0 * run.scene.liquid.viscosity) * 0.02 * 0.5;
  EXPECT_NEAR(given, theory, 0.01 * theory);
  EXPECT_NEAR(spent, given, 0.01 * given);
}

// Over an open top the gas outside is at rest, along a periodic direction too: what is inside is not let fall
// in it, but goes with the film.
TEST(Film, DragsTheGasAndIsNotOutrunByIt) {
  Simulation run(tank({"tank.size=[0.02, 0.02]", "grid.dx=0.0025", "liquid.level=0.01", "liquid.viscosity=1",
                       "walls.left=periodic", "walls.right=periodic", "walls.top=open", "model.les=false",
                       "tank.inclination=10"}));
  const EnergyTerms start = run.now.energy;
  run.until(1.0);
  ASSERT_FALSE(HasFatalFailure());
  const double force = (run.scene.liquid.density - run.scene.gas.density) * gravity_of(run.scene)[0];
  const double surface = 0.5 * force * 0.01 * 0.01 / run.scene.liquid.viscosity;
  EXPECT_NEAR(run.now.u_c[0][run.cell(1, 3)], surface, 0.1 * surface);
  EXPECT_LT(std::fabs(run.now.u_c[0][run.cell(1, 7)]), 1.1 * surface);
  EXPECT_LT(std::fabs(run.now.energy.residual), 1e-6 * energy_turnover(run.scene, start, run.now.energy));
}

class Sloshing : public ::testing::TestWithParam<Variant> {};

// A level along the floor is no level: the liquid runs to the lower end, and comes to rest there.
TEST_P(Sloshing, KeepsVolumeAndEnergy) {
  Simulation run(tank(GetParam().overrides));
  const EnergyTerms start = run.now.energy;
  const auto moment = [&] {
    double sum = 0.0;
    for (int j = 0; j < run.grid.cells.n[1]; ++j)
      for (int i = 0; i < run.grid.cells.n[0]; ++i)
        sum += (i + 0.5) * run.now.alpha[run.cell(i, j)] * (1.0 - run.now.f_s[run.cell(i, j)]);
    return sum;
  };
  const double before = moment();
  run.until(0.6);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_GT(moment(), 1.05 * before);
  const EnergyTerms& e = run.now.energy;
  const double turnover = energy_turnover(run.scene, start, e);
  EXPECT_LT(std::fabs(e.residual), 1e-3 * turnover);
  EXPECT_LT(e.potential, start.potential);
}

INSTANTIATE_TEST_SUITE_P(
    Tanks, Sloshing,
    ::testing::Values(Variant{"closed", {"liquid.level=0.03", "tank.inclination=10"}},
                      Variant{"open", {"liquid.level=0.03", "tank.inclination=10", "walls.top=open"}}),
    name_of);

class Level : public ::testing::TestWithParam<Variant> {};

// What is level stays so, however the surface lies in the cells. With the mean density alone on faces water
// stirs: at 0.1 to 0.5 of the speed that follows.
TEST_P(Level, StaysLevel) {
  Simulation run(tank(GetParam().overrides));
  run.now.alpha = test::level_surface(run.grid, run.scene, 0.04, 0.03);
  run.fill_ghosts();
  for (int step = 0; step < 200; ++step) {
    run.advance(2e-3);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_LT(run.fastest(run.now.u_c), 1e-2 * std::sqrt(run.scene.gravity * 0.03));
}

INSTANTIATE_TEST_SUITE_P(Tanks, Level,
                         ::testing::Values(Variant{"by_half_a_degree", {"tank.inclination=0.5"}},
                                           Variant{"by_ten_degrees", {"tank.inclination=10"}},
                                           Variant{"by_25_degrees", {}},
                                           Variant{"to_the_left", {"tank.inclination=-10"}},
                                           Variant{"steep", {"tank.inclination=65"}},
                                           Variant{"open", {"tank.inclination=10", "walls.top=open"}}),
                         name_of);

// Water along the floor of a tank that is tilted by a little sways about the level: rho g theta^2 L^3 / 24 of
// depth is what it has, and no more may move. Some six times as much did after 20 s.
TEST(Level, SwaysWithWhatItWasGiven) {
  Simulation run(test::small_tank("sway", "size = [0.3, 0.12]\ninclination = 0.5", 0.065,
                                  "[walls]\nall = \"no-slip\"\ntop = \"open\"\n", {"grid.dx=0.01"}));
  const double angle = 0.5 * std::numbers::pi / 180.0;
  const double given = 1000.0 * 9.81 * angle * angle * 0.3 * 0.3 * 0.3 / 24.0 * run.scene.tank[2];
  double most = 0.0;
  run.until(20.0, [&] { most = std::fmax(most, run.now.energy.kinetic); });
  ASSERT_FALSE(HasFatalFailure());
  std::printf("  %.3g of it\n", most / given);
  EXPECT_GT(most, 0.5 * given);
  EXPECT_LT(most, given);
}

// Grains on a rough floor: they stay on a slope below their friction and run down a steeper one.
TEST(Bed, StaysOnAFlatSlopeAndRunsDownASteepOne) {
  const auto speed = [](const std::string& inclination) {
    Simulation run(tank({"tank.inclination=" + inclination, "walls.left=periodic", "walls.right=periodic",
                         "bed.length=0.08", "bed.height=0.04", "bed.solid_fraction=0.58", "liquid=false"}));
    run.until(0.4);
    double sum = 0.0;
    for (int i = 0; i < run.grid.cells.n[0]; ++i) sum += run.now.u_s[0][run.cell(i, 6)] / run.grid.cells.n[0];
    return sum;
  };
  EXPECT_LT(std::fabs(speed("10")), 2e-3);
  EXPECT_GT(speed("35"), 0.1);
}

}  // namespace
}  // namespace granvof
