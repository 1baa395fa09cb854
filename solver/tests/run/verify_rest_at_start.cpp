// What can be at rest is at rest from the first step on, wherever level and bed end within their cells.
#include <cmath>

#include "solver/tests/run/override_sets.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::joined;
using test::Set;
using test::Simulation;
using test::Variant;

// A bed from side to side that bears itself, in a tank of 8 x 16 cells of 5 mm.
Scene tank(const Set& overrides) {
  return test::small_tank("rest", "size = [0.04, 0.08]", 0.06, R"([walls]
all = "slip"
top = "open"
[bed]
length = 0.04
height = 0.03
solid_fraction = 0.6
[model]
packing = "carried"
[numerics]
bed_surface = "whole-cells"
volume_tolerance = 1e-12
linear_tolerance = 1e-8
)",
                          overrides);
}

class Start : public ::testing::TestWithParam<Variant> {};

// Velocities against those of waves on the depth of the tank, pressures against its weight of water.
TEST_P(Start, IsTheRestOfTheScheme) {
  Simulation run(tank(GetParam().overrides));
  const Field p_c = run.now.p_c, p_s = run.now.p_s;
  double speed = 0.0, change = 0.0;
  for (int step = 0; step < 10; ++step) {
    run.advance(1e-3);
    ASSERT_FALSE(HasFatalFailure());
    speed = std::fmax(speed, std::fmax(run.fastest(run.now.u_c), run.fastest(run.now.u_s)));
    for_each_place(run.grid.all_cells(), [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = run.grid.cells.index(at);
      change = std::fmax(change,
                         std::fmax(std::fabs(run.now.p_c[c] - p_c[c]), std::fabs(run.now.p_s[c] - p_s[c])));
    });
  }
  std::printf("  %.2g m/s, %.2g Pa\n", speed, change);
  EXPECT_LT(speed, 1e-7 * std::sqrt(9.81 * 0.08));
  EXPECT_LT(change, 1e-5 * 9810.0 * 0.08);
}

const Set no_grains{"bed=false", "solid=false", "model.packing=uniform"}, lid{"walls.top=slip"};

INSTANTIATE_TEST_SUITE_P(
    Beds, Start,
    ::testing::Values(
        Variant{"level_above", {}}, Variant{"level_at_the_surface", {"liquid.level=0.03"}},
        Variant{"level_in_the_uppermost_cell", {"liquid.level=0.0287"}},
        Variant{"level_in_the_cell_above", {"liquid.level=0.0312"}},
        Variant{"level_inside", {"liquid.level=0.02"}},
        Variant{"level_inside_a_cell_inside", {"liquid.level=0.0212"}},
        Variant{"level_at_the_surface_under_a_lid", joined({lid, {"liquid.level=0.03"}})},
        Variant{"level_in_the_uppermost_cell_under_a_lid", joined({lid, {"liquid.level=0.0287"}})},
        Variant{"between_joined_ends",
                {"liquid.level=0.0287", "walls.left=periodic", "walls.right=periodic"}},
        Variant{"in_3d", {"liquid.level=0.0287", "scene.dimensions=3", "tank.size=[0.04, 0.08, 0.02]"}},
        Variant{"up_to_the_open_top", {"liquid.level=0.07", "bed.height=0.08"}},
        Variant{"dry", {"liquid=false"}},
        Variant{"dry_up_to_the_open_top", {"liquid=false", "bed.height=0.08"}},
        Variant{"light_under_a_lid", joined({lid, {"solid.density=400", "bed.y=0.05", "liquid.level=0.08"}})},
        Variant{"light_under_a_lid_level_at_its_bottom",
                joined({lid, {"solid.density=1.5", "gas.density=2", "bed.y=0.05", "liquid.level=0.05"}})},
        Variant{"on_a_plate",
                {"obstacle.x0=[0]", "obstacle.x1=[0.04]", "obstacle.y0=[0.02]", "obstacle.y1=[0.025]",
                 "bed.y=0.025", "bed.height=0.02", "liquid.level=0.0438"}}),
    test::name_of);

// Gas at rest beside water that obstacles hold.
const Set basin{"obstacle.x0=[0.02, 0.025, 0.035]", "obstacle.x1=[0.025, 0.035, 0.04]",
                "obstacle.y0=[0.04, 0.04, 0.04]",   "obstacle.y1=[0.06, 0.045, 0.06]",
                "liquid.box.origin=[0.025, 0.045]", "liquid.box.size=[0.01, 0.0112]"};
const Set bell{"obstacle.x0=[0.01, 0.03, 0.01]", "obstacle.x1=[0.015, 0.035, 0.035]",
               "obstacle.y0=[0.02, 0.02, 0.055]", "obstacle.y1=[0.055, 0.055, 0.06]"};

INSTANTIATE_TEST_SUITE_P(
    Pools, Start,
    ::testing::Values(
        Variant{"level_inside_a_cell", joined({no_grains, {"liquid.level=0.0412"}})},
        Variant{"full_on_a_slope", joined({no_grains, lid, {"liquid.level=0.08", "tank.inclination=20"}})},
        Variant{"basin_above_gas", joined({no_grains, basin, {"liquid.level=0.0112"}})},
        Variant{"basin_above_gas_under_a_lid", joined({no_grains, basin, lid, {"liquid.level=0.0112"}})},
        Variant{"basin_in_3d",
                joined({no_grains,
                        basin,
                        {"scene.dimensions=3", "tank.size=[0.04, 0.08, 0.02]", "liquid.level=0.0112",
                         "liquid.box.origin=[0.025, 0.045, 0]", "liquid.box.size=[0.01, 0.0112, 0.02]"}})},
        Variant{"bell_of_gas",
                joined({no_grains,
                        bell,
                        {"liquid.level=0.0312", "liquid.box.origin=[0, 0.0312]",
                         "liquid.box.size=[0.01, 0.0275]", "obstacle.x1=[0.015, 0.04, 0.04]"}})},
        Variant{"full_bell", joined({no_grains, bell, {"liquid.level=0.0662"}})}),
    test::name_of);

// A block that hangs from an open top, above a pool: all that keeps the fluid from rest is what waits beyond
// the top, next to nothing, and the pressure is solved for to a share of that. To a share of nothing the
// solver went on until rounding had made 1e14 Pa of it.
class HangingBlock : public ::testing::TestWithParam<Variant> {};

TEST_P(HangingBlock, StartsAtThePressureOfItsFluid) {
  Simulation run(tank(joined({{"bed.length=0.02", "liquid.level=0.03"}, GetParam().overrides})));
  const double g = 9.81, h = run.grid.h[1], top = 0.08, level = 0.03;
  for_each_place(run.grid.all_cells(), [&](const std::array<int, 3>& at) {
    const double y = (at[1] + 0.5) * h;
    const double weight = g * ((top - std::fmax(y, level)) * 1.0 + std::fmax(level - y, 0.0) * 1000.0);
    EXPECT_NEAR(run.now.p_c[run.grid.cells.index(at)], weight, 2.0 * g * h * 1.0) << at[0] << ' ' << at[1];
  });
  run.advance();
}

INSTANTIATE_TEST_SUITE_P(Beds, HangingBlock,
                         ::testing::Values(Variant{"at_the_top", {"bed.y=0.05", "bed.height=0.03"}},
                                           Variant{"of_few_cells", {"bed.y=0.07", "bed.height=0.01"}},
                                           Variant{"that_rounding_takes_into_the_last_cell",
                                                   {"bed.y=0.045", "bed.height=0.03000000000001"}}),
                         test::name_of);

}  // namespace
}  // namespace granvof
