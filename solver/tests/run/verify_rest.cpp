// What a tank at rest keeps: its liquid, and the level of its fluid pressure.
#include <ostream>

#include "solver/run/monitors.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::Simulation;

Scene tank(const std::vector<std::string>& overrides) {
  return parse_scene(R"([scene]
name = "tank"
[tank]
size = [0.04, 0.12]
[grid]
dx = 0.005
[walls]
all = "slip"
top = "open"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.08
[solid]
density = 2500
diameter = 0.8e-3
friction = 0.4
[bed]
length = 0.04
height = 0.05
solid_fraction = 0.574
[time]
end = 100
)",
                     "tank", overrides);
}

struct Case {
  std::string name;
  std::vector<std::string> overrides;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}
const auto name_of = [](const auto& instance) { return instance.param.name; };

class Liquid : public ::testing::TestWithParam<Case> {};

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

INSTANTIATE_TEST_SUITE_P(Beds, Liquid,
                         ::testing::Values(Case{"level_inside_the_bed", {"liquid.level=0.03"}},
                                           Case{"level_inside_a_row", {"liquid.level=0.0312"}},
                                           Case{"level_at_the_surface", {"liquid.level=0.05"}},
                                           Case{"level_inside_a_heap",
                                                {"liquid.level=0.015", "bed.length=0.035", "bed.height=0.03",
                                                 "bed.slope=45", "walls.bottom=no-slip"}},
                                           Case{"sealed", {"liquid.level=0.03", "walls.top=slip"}},
                                           Case{"sealed_and_joined",
                                                {"liquid.level=0.03", "walls.top=slip", "walls.left=periodic",
                                                 "walls.right=periodic"}},
                                           Case{"light_bed", {"liquid.level=0.03", "solid.density=1050"}},
                                           Case{"floating_bed",
                                                {"solid.density=400", "liquid.level=0.06", "bed.y=floating"}},
                                           Case{"sealed_suspension",
                                                {"liquid.level=0.1", "walls.top=slip", "bed.height=0.09",
                                                 "bed.solid_fraction=0.2"}}),
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

class PressureLevel : public ::testing::TestWithParam<Case> {};

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
    ::testing::Values(Case{"with_gas", {}}, Case{"without_gas", {"liquid.level=0.12"}},
                      Case{"periodic_sides", {"walls.left=periodic", "walls.right=periodic"}},
                      Case{"in_3d", {"scene.dimensions=3", "tank.size=[0.04, 0.12, 0.02]"}},
                      Case{"without_grains", {"bed=false", "solid=false"}}),
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

}  // namespace
}  // namespace granvof
