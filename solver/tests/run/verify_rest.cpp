// What a tank at rest keeps: its liquid, the level of its fluid pressure, and its rest.
#include <cmath>

#include "solver/operators/mixture.hpp"
#include "solver/run/monitors.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::name_of;
using test::Simulation;
using test::Variant;

Scene tank(const std::vector<std::string>& overrides) {
  return test::small_tank("tank", "size = [0.04, 0.12]", 0.08, R"([walls]
all = "slip"
top = "open"
[bed]
length = 0.04
height = 0.05
solid_fraction = 0.574
)",
                          overrides);
}

class Liquid : public ::testing::TestWithParam<Variant> {};

// The water that is there and the water that ran out of the top, against what was there at the start:
// rounding, with the default tolerances. These 400 steps lost 1e-7 to 2e-5 of it before the fluxes closed
// continuity.
TEST_P(Liquid, IsKeptToRounding) {
  for (const char* scheme : {"cicsam", "plic", "upwind"}) {
    std::vector<std::string> overrides = GetParam().overrides;
    overrides.push_back(std::string("numerics.interface_scheme=") + scheme);
    Simulation run(tank(overrides));
    Monitors monitors(run.grid, run.scene, run.now);
    double least = 0.0, most = 0.0;
    run.until(2.0, [&] {
      monitors.update(run.now, run.last.liquid_left, run.last.solid_left);
      const double* a = run.now.alpha.data();
      most = max_over(run.grid.cells, run.grid.all_cells(), most, [=](std::ptrdiff_t c) { return a[c]; });
      least =
          -max_over(run.grid.cells, run.grid.all_cells(), -least, [=](std::ptrdiff_t c) { return -a[c]; });
    });
    ASSERT_FALSE(HasFatalFailure()) << scheme;
    EXPECT_LT(monitors.liquid_volume_error(), 1e-12) << scheme;
    EXPECT_LT(monitors.solid_volume_error(), 1e-12) << scheme;
    EXPECT_GE(least, 0.0);
    EXPECT_LE(most, 1.0);
    EXPECT_GT(run.steps, 300);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Beds, Liquid,
    ::testing::Values(
        Variant{"level_inside_the_bed", {"liquid.level=0.03"}},
        Variant{"level_inside_a_row", {"liquid.level=0.0312"}},
        Variant{"level_at_the_surface", {"liquid.level=0.05"}},
        Variant{"level_inside_a_heap",
                {"liquid.level=0.015", "bed.length=0.035", "bed.height=0.03", "bed.slope=45",
                 "walls.bottom=no-slip"}},
        Variant{"sealed", {"liquid.level=0.03", "walls.top=slip"}},
        Variant{"sealed_and_joined",
                {"liquid.level=0.03", "walls.top=slip", "walls.left=periodic", "walls.right=periodic"}},
        Variant{"light_bed", {"liquid.level=0.03", "solid.density=1050"}},
        Variant{"floating_bed", {"solid.density=400", "liquid.level=0.06", "bed.y=floating"}},
        Variant{"sealed_suspension",
                {"liquid.level=0.1", "walls.top=slip", "bed.height=0.09", "bed.solid_fraction=0.2"}}),
    name_of);

// Mean P_c on the lid by the definition of the level, and at the lowest cells [Pa].
struct Pressure {
  double lid = 0.0, base = 0.0;
};
Pressure mean_pressure(const Simulation& run) {
  const Layout& l = run.grid.cells;
  Pressure mean;
  for (int k = 0; k < l.n[2]; ++k)
    for (int i = 0; i < l.n[0]; ++i) {
      const std::ptrdiff_t high = l.index(i, l.n[1] - 1, k);
      const double a = run.now.alpha[high];
      const double density = a * run.scene.liquid.density + (1.0 - a) * run.scene.gas.density;
      mean.lid += run.now.p_c[high] - 0.5 * run.grid.h[1] * density * run.scene.gravity;
      mean.base += run.now.p_c[l.index(i, 0, k)];
    }
  const double columns = l.n[0] * l.n[2];
  return {mean.lid / columns, mean.base / columns};
}

class PressureLevel : public ::testing::TestWithParam<Variant> {};

// As under an open top, from the first step to the last, while the bed takes its weight. It wandered by tens
// of Pa. What is left of the pressure that the settling grains put on the water is below 1 Pa after half a
// second.
TEST_P(PressureLevel, StandsInASealedTank) {
  std::vector<std::string> sealed = GetParam().overrides;
  sealed.push_back("walls.top=slip");
  Simulation run(tank(sealed));
  const double at_rest = mean_pressure(run).base;
  double lid = std::fabs(mean_pressure(run).lid), base = 0.0;
  run.until(2.0, [&] {
    const Pressure p = mean_pressure(run);
    lid = std::fmax(lid, std::fabs(p.lid));
    if (run.now.time > 0.5) base = std::fmax(base, std::fabs(p.base - at_rest));
  });
  EXPECT_LT(lid, 1e-10 * at_rest);
  EXPECT_LT(base, 1.0);
  EXPECT_GT(at_rest, 700.0);
}

INSTANTIATE_TEST_SUITE_P(
    Tanks, PressureLevel,
    ::testing::Values(Variant{"with_gas", {}}, Variant{"without_gas", {"liquid.level=0.12"}},
                      Variant{"periodic_sides", {"walls.left=periodic", "walls.right=periodic"}},
                      Variant{"in_3d", {"scene.dimensions=3", "tank.size=[0.04, 0.12, 0.02]"}},
                      Variant{"without_grains", {"bed=false", "solid=false"}}),
    name_of);

// Grains that settle through a sealed tank: the base carries the grains' weight first and the water's alone
// at the end, never less.
TEST(PressureLevel, NoSuctionIsLeftBySettledGrains) {
  Simulation run(tank({"walls.top=slip", "liquid.level=0.12", "bed.height=0.12", "bed.solid_fraction=0.1",
                       "solid.diameter=2e-3"}));
  const double water = mean_pressure(run).base;
  double least = water;
  run.until(3.0, [&] { least = std::fmin(least, mean_pressure(run).base); });
  const double grains = 0.1 * 1500.0 * 9.81 * 0.12;  // their submerged weight per area [Pa]
  EXPECT_GT(least, water - 0.02 * grains);
  EXPECT_NEAR(mean_pressure(run).base, water, 0.02 * grains);
}

// A slope at rest that the level cuts: beside it no pressure was at rest, and water stirred at a tenth of a
// metre per second for good.
TEST(Slope, ThatTheLevelCutsIsAtRest) {
  for (const char* level : {"0.02", "0.022", "0.0235"}) {
    Simulation run(test::small_tank("slope", "size = [0.15, 0.05]", 0.02, R"([walls]
all = "no-slip"
top = "open"
[bed]
length = 0.1
height = 0.03
slope = 18
solid_fraction = 0.6
)",
                                    {std::string("liquid.level=") + level}));
    run.until(2.0);
    ASSERT_FALSE(HasFatalFailure());
    std::printf("  %.2g and %.2g m/s\n", run.fastest(run.now.u_c), run.fastest(run.now.u_s));
    EXPECT_LT(run.fastest(run.now.u_c), 0.02 * std::sqrt(9.81 * 0.02)) << level;
  }
}

// Under an open top the fluid carries the weight of what fills the cells up to it, and no more or less: a
// tank full to the brim, one that runs over, one whose surface lies inside the last row.
class OpenTop : public ::testing::TestWithParam<Variant> {};

TEST_P(OpenTop, BearsTheWeightOfTheCellsBelowIt) {
  std::vector<std::string> overrides = GetParam().overrides;
  overrides.insert(overrides.end(), {"bed=false", "solid=false"});
  Simulation run(tank(overrides));
  run.until(0.5);
  ASSERT_FALSE(HasFatalFailure());
  const Layout& l = run.grid.cells;
  double weight = 0.0;  // above the middle of the lowest row
  for (int j = 0; j < l.n[1]; ++j)
    weight += (j == 0 ? 0.5 : 1.0) * run.grid.h[1] * run.scene.gravity *
              mixture(run.now.alpha[l.index(2, j, 0)], run.scene.liquid.density, run.scene.gas.density);
  const Pressure p = mean_pressure(run);
  EXPECT_NEAR(p.lid, 0.0, 1e-4 * weight);
  EXPECT_NEAR(p.base, weight, 1e-4 * weight);
}

INSTANTIATE_TEST_SUITE_P(
    Tanks, OpenTop,
    ::testing::Values(Variant{"to_the_brim", {"liquid.level=0.12"}},
                      Variant{"running_over", {"liquid.level=0.12", "walls.bottom.inflow=0.05"}},
                      Variant{"inside_the_last_row", {"liquid.level=0.1175"}},
                      Variant{"far_below", {"liquid.level=0.06"}},
                      Variant{"in_3d",
                              {"liquid.level=0.12", "scene.dimensions=3", "tank.size=[0.02, 0.12, 0.02]"}}),
    name_of);

class Pool : public ::testing::TestWithParam<Variant> {};

// Nothing stirs still fluid, and what rounding does must not grow. Where the first guess of the pressure
// counts as a solution as soon as it is within the tolerance, waves grow to 1e-5 m/s in the water and to
// 2e-3 in the air within 20 s.
TEST_P(Pool, NoWaveGrowsFromRounding) {
  Simulation run(test::small_tank("pool", "size = [0.2, 0.1]", 0.08, R"([walls]
all = "no-slip"
top = "open"
[bed]
y = 0.02
length = 0.1
height = 0.05
solid_fraction = 0.5
)",
                                  GetParam().overrides));
  double water = 0.0, air = 0.0;
  run.until(25.0, [&] {
    for (int d = 0; d < run.grid.dim; ++d) {
      const double *u = run.now.u_c[d].data(), *alpha = run.now.alpha.data();
      const std::ptrdiff_t s = run.grid.stride(d);
      const auto speed_where = [&](double liquid) {
        return max_over(run.grid.cells, run.grid.fluid_faces(d), 0.0, [=](std::ptrdiff_t c) {
          return (alpha[c] > 0.5 || alpha[c - s] > 0.5) == (liquid > 0.5) ? std::fabs(u[c]) : 0.0;
        });
      };
      water = std::fmax(water, speed_where(1.0));
      air = std::fmax(air, speed_where(0.0));
    }
  });
  const double scale = std::sqrt(9.81 * 0.08);
  EXPECT_LT(water, 1e-7 * scale);
  EXPECT_LT(air, 1e-5 * scale);
  EXPECT_GT(run.steps, 2000);
}

INSTANTIATE_TEST_SUITE_P(Tanks, Pool,
                         ::testing::Values(Variant{"level_on_a_face", {"bed=false", "solid=false"}},
                                           Variant{"level_inside_a_row",
                                                   {"liquid.level=0.0812", "bed=false", "solid=false"}},
                                           Variant{"grains_as_heavy_as_water", {"solid.density=1000"}}),
                         name_of);

}  // namespace
}  // namespace granvof
