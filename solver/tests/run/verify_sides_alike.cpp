// What a side of the tank does may not depend on which of the six it is: mirrored in every axis and with axes
// exchanged, with walls that move, inlets, outlets and obstacles. With gravity x and z are alike; without it
// all axes are.
#include "solver/tests/run/mapped_runs.hpp"

namespace granvof {
namespace {

using test::Mapping;
using test::name_of;
using test::Variant;

constexpr int steps = 5;

void expect_alike(const Scene& scene, std::initializer_list<Mapping> maps) {
  for (const Mapping& map : maps) test::expect_same(scene, map(scene), map, steps);
}

// Tight tolerances, what all variants share, and then the variant's own.
std::vector<std::string> overrides_of(const Variant& variant, std::vector<std::string> shared) {
  std::vector<std::string> all = test::tightly_solved;
  all.insert(all.end(), shared.begin(), shared.end());
  all.insert(all.end(), variant.overrides.begin(), variant.overrides.end());
  return all;
}

class UnderGravity : public ::testing::TestWithParam<Variant> {};

// A bed under water that touches no side, in a tank of 6 x 5 x 4 cells whose walls are all no-slip. Contacts
// without friction but where a variant has it: its solve stops at a tolerance of its own, and what it leaves
// (up to 1e-5 here) would hide what is looked for.
TEST_P(UnderGravity, XAndZAreAlike) {
  const Scene scene =
      test::small_tank("sides", "size = [0.03, 0.025, 0.02]", 0.0175,
                       R"([walls]
top = "open"
[bed]
x = 0.005
length = 0.01
height = 0.01
z = 0.005
width = 0.005
solid_fraction = 0.574
)",
                       overrides_of(GetParam(), {"scene.dimensions=3", "model.contact_friction=false"}));
  expect_alike(scene, {Mapping::mirror(0), Mapping::mirror(2), Mapping::exchange(0, 2)});
}

INSTANTIATE_TEST_SUITE_P(
    Sides, UnderGravity,
    ::testing::Values(
        Variant{"moving_wall", {"walls.left.velocity=[0, 0.1, 0.05]"}},
        Variant{"moving_wall_with_friction",
                {"walls.left.velocity=[0, 0.1, 0.05]", "model.contact_friction=true"}},
        Variant{"moving_coulomb_wall",
                {"walls.back.velocity=[0.05, 0.1, 0]", "walls.back.solid=coulomb",
                 "walls.back.solid_friction=0.3"}},
        Variant{"moving_bumpy_wall",
                {"walls.left.velocity=[0, 0.1, 0.05]", "walls.left.solid=bumpy", "walls.left.bumpiness=30",
                 "bed.x=0"}},
        Variant{"moving_wall_without_les", {"walls.back.velocity=[0.05, 0.1, 0]", "model.les=false"}},
        Variant{"moving_wall_in_syrup", {"walls.left.velocity=[0, 0.1, 0.05]", "liquid.viscosity=5"}},
        Variant{"moving_wall_sourced", {"walls.right.velocity=[0, 0.1, 0.05]", "model.preset=sourced"}},
        Variant{"moving_floor", {"walls.bottom.velocity=[0.1, 0, 0.05]"}},
        Variant{"inlet", {"walls.left.inflow=0.1", "walls.left.inflow_liquid_share=0.5"}},
        Variant{"inlet_and_outlet",
                {"walls.front.inflow=0.1", "walls.front.inflow_solid_fraction=0.2",
                 "walls.right.outflow_pressure=0", "walls.right.outflow_level=0.01"}},
        Variant{"inlet_and_outlet_paper",
                {"walls.right.inflow=0.1", "walls.right.inflow_solid_fraction=0.2",
                 "walls.front.outflow_pressure=0", "model.preset=paper"}},
        Variant{"outlet_beside_a_bed",
                {"walls.left.outflow_pressure=0", "bed.x=0", "bed.length=0.03", "bed.z=0", "bed.width=0.02"}},
        Variant{"obstacles",
                {"obstacle.x0=[0.02, 0]", "obstacle.x1=[0.03, 0.005]", "obstacle.y0=[0.005, 0]",
                 "obstacle.y1=[0.01, 0.02]", "obstacle.z0=[0, 0.01]", "obstacle.z1=[0.015, 0.02]"}}),
    name_of);

class WithoutGravity : public ::testing::TestWithParam<Variant> {};

// A dilute cloud in water, in a tank of 9 x 6 cells. The longest step is given: its default is of the tank's
// height.
TEST_P(WithoutGravity, XAndYAreAlike) {
  const Scene scene = test::small_tank("sides", "size = [0.045, 0.03]\ngravity = 0", 0.03, R"([bed]
x = 0.01
y = 0.01
length = 0.015
height = 0.01
solid_fraction = 0.3
[model]
preset = "paper"
)",
                                       overrides_of(GetParam(), {"numerics.dt_max=1e-3"}));
  expect_alike(scene, {Mapping::mirror(0), Mapping::mirror(1), Mapping::exchange(0, 1)});
}

// One side that the fluid passes gives the pressure its level.
INSTANTIATE_TEST_SUITE_P(
    Sides, WithoutGravity,
    ::testing::Values(
        Variant{"moving_wall", {"walls.left.velocity=[0, 0.1]", "walls.right.outflow_pressure=0"}},
        Variant{"moving_wall_in_syrup",
                {"walls.left.velocity=[0, 0.1]", "walls.right.outflow_pressure=0", "liquid.viscosity=5"}},
        Variant{"through_the_tank", {"walls.left.inflow=0.1", "walls.right.outflow_pressure=0"}},
        Variant{"around_a_corner", {"walls.left.inflow=0.1", "walls.top.outflow_pressure=0"}},
        Variant{"with_grains",
                {"walls.bottom.inflow=0.1", "walls.bottom.inflow_solid_fraction=0.2",
                 "walls.right.outflow_pressure=0", "numerics.solid_flux=limited"}},
        Variant{"between_two_pressures", {"walls.left.outflow_pressure=50", "walls.top.outflow_pressure=0"}}),
    name_of);

}  // namespace
}  // namespace granvof
