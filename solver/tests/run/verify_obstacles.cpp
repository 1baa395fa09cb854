// Boxes inside the tank: what rests beside them rests, what flows past them sticks to them.
#include <cmath>

#include "solver/run/alarms.hpp"
#include "solver/run/monitors.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::name_of;
using test::Simulation;
using test::Variant;

// A step of 2 x 2 cells in the middle of the floor.
Scene tank(const std::vector<std::string>& overrides) {
  return test::small_tank(
      "step", "size = [0.08, 0.06]", 0.04,
      std::string("[[obstacle]]\nx0 = 0.03\nx1 = 0.04\ny0 = 0.0\ny1 = 0.02\n").append(test::tight_tolerances),
      overrides);
}

double largest_inside(const Simulation& run) {
  double most = 0.0;
  const auto look = [&](double v) { most = std::fmax(most, std::fabs(v)); };
  for (const std::ptrdiff_t c : run.grid.obstacles.cells()) {
    look(run.now.f_s[c]);
    look(run.now.alpha[c]);
    look(run.now.theta[c]);
    for (int d = 0; d < run.grid.dim; ++d)
      for (const std::ptrdiff_t face : {c, c + run.grid.stride(d)}) {
        look(run.now.u_c[d][face]);
        look(run.now.u_s[d][face]);
      }
  }
  return most;
}

class Rest : public ::testing::TestWithParam<Variant> {};

TEST_P(Rest, APoolStaysAtRest) {
  Simulation run(tank(GetParam().overrides));
  Monitors monitors(run.grid, run.scene, run.now);
  const double start = run.now.energy.stored();
  run.until(0.5, [&] { monitors.update(run.now, run.last.liquid_left, run.last.solid_left); });
  ASSERT_FALSE(HasFatalFailure());
  // In 3D the solver leaves more: 3e-10 m/s in the same tank without obstacles.
  EXPECT_LT(run.fastest(run.now.u_c), run.grid.dim == 2 ? 1e-12 : 1e-9);
  EXPECT_LT(monitors.liquid_volume_error(), 1e-13);
  EXPECT_EQ(largest_inside(run), 0.0);
  EXPECT_NEAR(run.now.energy.stored(), start, 1e-12 * start);
  EXPECT_GE(run.grid.obstacles.cells().size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(
    Tanks, Rest,
    ::testing::Values(
        Variant{"step_under_an_open_top", {"walls.top=open"}}, Variant{"step_under_a_lid", {}},
        Variant{"step_in_3d", {"scene.dimensions=3", "tank.size=[0.08, 0.06, 0.03]"}},
        Variant{"block_in_3d",
                {"scene.dimensions=3", "tank.size=[0.08, 0.06, 0.03]", "obstacle.z0=[0.01]",
                 "obstacle.z1=[0.02]"}},
        // two basins, joined by a slit at the floor; above the water the wall goes on to the lid
        Variant{"slit", {"obstacle.y0=[0.01]", "obstacle.y1=[0.06]"}},
        Variant{"hanging_in_the_water", {"obstacle.y0=[0.02]", "obstacle.y1=[0.03]"}},
        Variant{"on_the_seam",
                {"walls.left=periodic", "walls.right=periodic", "obstacle.x0=[0.0]", "obstacle.x1=[0.01]"}}),
    name_of);

// Two basins that start at different levels meet through a slit at the floor: half the sum of both.
TEST(Slit, JoinsTwoBasins) {
  Simulation run(
      tank({"tank.size=[0.08, 0.08]", "walls.top=open", "liquid.box.origin=[0, 0]",
            "liquid.box.size=[0.03, 0.06]", "liquid.level=0.02", "liquid.viscosity=0.05",
            "obstacle.x0=[0.03]", "obstacle.y0=[0.01]", "obstacle.x1=[0.05]", "obstacle.y1=[0.08]"}));
  Monitors monitors(run.grid, run.scene, run.now);
  const auto level = [&](int i) {
    double sum = 0.0;
    for (int j = 0; j < run.grid.cells.n[1]; ++j) sum += run.now.alpha[run.cell(i, j)] * run.grid.h[1];
    return sum;
  };
  EXPECT_NEAR(level(2) - level(13), 0.04, 1e-12);
  run.until(3.0, [&] { monitors.update(run.now, run.last.liquid_left, run.last.solid_left); });
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_NEAR(level(2), 0.04, 2e-4);
  EXPECT_NEAR(level(13), 0.04, 2e-4);
  EXPECT_LT(monitors.liquid_volume_error(), 1e-12);
  EXPECT_EQ(largest_inside(run), 0.0);
}

// Liquid driven between the floor and a long plate: a parabola that both hold, u = f y (H - y) / (2 mu). The
// same through the explicit and the implicit viscosity.
TEST(Plate, HoldsTheFluid) {
  for (const bool implicit : {false, true}) {
    const std::string viscosity = implicit ? "1" : "0.01";
    Simulation run(
        tank({"tank.inclination=10", "walls.left=periodic", "walls.right=periodic", "tank.size=[0.02, 0.02]",
              "grid.dx=0.00125", "liquid.level=0.02", "model.les=false", "liquid.viscosity=" + viscosity,
              "tank.gravity=9.81e-3", "obstacle.x0=[0]", "obstacle.x1=[0.02]", "obstacle.y0=[0.01]",
              "obstacle.y1=[0.02]", implicit ? "numerics.dt_max=0.5" : "numerics.dt_max=0.02"}));
    const double mu = run.scene.liquid.viscosity, depth = 0.01, h = run.grid.h[1];
    const double force = 1000.0 * 9.81e-3 * std::sin(10.0 * 3.14159265358979 / 180.0);
    run.until(implicit ? 2.0 : 12.0);
    ASSERT_FALSE(HasFatalFailure());
    double largest = 0.0;
    for (int j = 0; j < 8; ++j) {
      const double y = (j + 0.5) * h, u = run.now.u_c[0][run.cell(3, j)];
      largest = std::fmax(largest, std::fabs(u - 0.5 * force / mu * y * (depth - y)));
    }
    EXPECT_LT(largest, 0.14 * force * h * h / mu) << viscosity;
    // What gravity gives viscosity takes, the plate's half cell included.
    const EnergyTerms before = run.now.energy;
    run.until(run.now.time + 2.0);
    const double given = before.outflow - run.now.energy.outflow;
    EXPECT_NEAR(run.now.energy.viscosity - before.viscosity, given, 0.02 * given) << viscosity;
  }
}

// Grains on a step stay there; a bed beside it leans on it. What is in the tank is kept, and the energy of
// it.
TEST(Grains, SettleOnAndBesideAStep) {
  Simulation run(
      tank({"bed.x=0", "bed.length=0.08", "bed.height=0.025", "bed.y=0.025", "bed.solid_fraction=0.5",
            "walls.top=open", "liquid.level=0.055", "numerics.volume_tolerance=1e-6"}));
  Monitors monitors(run.grid, run.scene, run.now);
  const EnergyTerms start = run.now.energy;
  run.until(1.5, [&] { monitors.update(run.now, run.last.liquid_left, run.last.solid_left); });
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(monitors.solid_volume_error(), 1e-12);
  EXPECT_LT(monitors.liquid_volume_error(), 1e-12);
  EXPECT_EQ(largest_inside(run), 0.0);
  EXPECT_GT(run.now.f_s[run.cell(7, 4)], 0.5);   // on the step
  EXPECT_GT(run.now.f_s[run.cell(2, 0)], 0.55);  // beside it, on the floor
  double fastest = 0.0;                          // of grains that lie
  for (int d = 0; d < 2; ++d) {
    const double *f = run.now.f_s.data(), *u = run.now.u_s[d].data();
    const std::ptrdiff_t s = run.grid.stride(d);
    fastest = max_over(run.grid.cells, run.grid.inner_faces(d), fastest, [=](std::ptrdiff_t c) {
      return std::fmin(f[c], f[c - s]) > 0.5 ? std::fabs(u[c]) : 0.0;
    });
  }
  EXPECT_LT(fastest, 5e-3);
  const double turnover = energy_turnover(run.scene, start, run.now.energy);
  EXPECT_LT(std::fabs(run.now.energy.residual), 1e-3 * turnover);
}

// A tank mirrored runs mirrored: obstacles have no preferred side.
TEST(Step, IsMirrored) {
  const std::vector<std::string> column{"walls.top=open", "liquid.level=0.02", "liquid.box.size=[0.02, 0.05]",
                                        "obstacle.y1=[0.01]"};
  std::vector<std::string> left = column, right = column;
  left.insert(left.end(), {"liquid.box.origin=[0, 0]", "obstacle.x0=[0.03]", "obstacle.x1=[0.04]"});
  right.insert(right.end(), {"liquid.box.origin=[0.06, 0]", "obstacle.x0=[0.04]", "obstacle.x1=[0.05]"});
  Simulation a{tank(left)}, b{tank(right)};
  for (int i = 0; i < 20; ++i) {
    a.advance(1e-3);
    b.advance(1e-3);
    if (HasFatalFailure()) return;
  }
  double apart = 0.0;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 16; ++i)
      apart = std::fmax(apart, std::fabs(a.now.alpha[a.cell(i, j)] - b.now.alpha[b.cell(15 - i, j)]));
  EXPECT_LT(apart, 1e-6);
  EXPECT_GT(a.fastest(a.now.u_c), 0.05);
}

}  // namespace
}  // namespace granvof
