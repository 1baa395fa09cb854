// A slab of dry grains, periodic along its floor, slides as a block does, whatever the step, or stays: on a
// Coulomb floor, and on a rough one, above its lowest grains.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/simulation.hpp"

namespace granvof {
namespace {

constexpr double friction = 0.3;  // of the floor

struct Variant {
  const char* name;
  const char* preset;
  double inclination;  // [degrees]
  double dt_max;       // [s]
};

Scene slab(const Variant& v) {
  std::vector<std::string> overrides{
      "tank.size=[0.04, 0.04]",
      "grid.dx=0.004",
      "walls.left=periodic",
      "walls.right=periodic",
      "walls.bottom={fluid=\"slip\", solid=\"coulomb\", solid_friction=" + std::to_string(friction) + "}",
      "walls.top=slip",
      "gate=false",
      "bed.length=0.04",
      "bed.height=0.02",
      "bed.solid_fraction=0.6",

      "solid.friction=0.5",
      "model.drag=false",
      "gas.density=0.05"};
  overrides.push_back("tank.inclination=" + std::to_string(v.inclination));
  overrides.push_back("numerics.dt_max=" + std::to_string(v.dt_max));
  overrides.push_back(std::string("model.preset=") + v.preset);
  return load_scene(cases_directory() / "dry-column.toml", overrides);
}

// Of all grains, along the floor [m/s].
double mean_speed(const test::Simulation& run) {
  double grains = 0.0, moved = 0.0;
  for (int j = 0; j < run.grid.cells.n[1]; ++j) {
    const std::ptrdiff_t c = run.cell(1, j);
    grains += run.now.f_s[c];
    moved += run.now.f_s[c] * run.now.u_s[0][c];
  }
  return moved / grains;
}

class Slab : public ::testing::TestWithParam<Variant> {};

TEST_P(Slab, SlidesAsABlock) {
  const Variant& v = GetParam();
  test::Simulation run(slab(v));
  const double angle = v.inclination * M_PI / 180.0;
  const double down = v.inclination > 0.0 ? 1.0 : -1.0;
  const double driven = run.scene.gravity * (std::sin(down * angle) - friction * std::cos(angle));
  const double weight = run.scene.gravity * std::sin(down * angle);  // along the floor
  const auto slid = [&](double time) { return down * std::max(driven, 0.0) * time; };
  run.until(0.01);  // from the first steps on
  EXPECT_NEAR(mean_speed(run), slid(0.01), 0.05 * weight * 0.01);
  run.until(0.2);
  EXPECT_NEAR(mean_speed(run), slid(0.2), 0.01 * weight * 0.2);
}

INSTANTIATE_TEST_SUITE_P(Steep, Slab,
                         ::testing::Values(Variant{"advised", "advised", 30.0, 1e-3},
                                           Variant{"advised_long_steps", "advised", 30.0, 5e-3},
                                           Variant{"advised_short_steps", "advised", 30.0, 2e-4},
                                           Variant{"sourced", "sourced", 30.0, 1e-3},
                                           Variant{"uphill", "advised", -30.0, 1e-3},
                                           Variant{"just_steep_enough", "advised", 18.0, 1e-3},
                                           Variant{"barely_steep_enough", "advised", 17.2, 1e-3},
                                           Variant{"barely_and_long_steps", "advised", 17.2, 5e-3}),
                         [](const auto& variant) { return std::string(variant.param.name); });
INSTANTIATE_TEST_SUITE_P(Flat, Slab, ::testing::Values(Variant{"advised_at_rest", "advised", 15.0, 1e-3}),
                         [](const auto& variant) { return std::string(variant.param.name); });

// Constant friction, an angle of repose of 21.8 degrees. What yields was held by the viscosity of its rest
// for the longer, the longer the step: at 25 degrees and 5 ms it had 0.73 of the block's speed.
class RoughFloor : public ::testing::TestWithParam<double> {};

TEST_P(RoughFloor, YieldsAtOnce) {
  constexpr double mu = 0.4;
  for (const double inclination : {22.5, 25.0, 30.0}) {
    Scene scene = slab({"", "advised", inclination, GetParam()});
    scene.sides[bottom] = {};
    scene.solid.friction = mu;
    scene.model.friction_law = {};
    scene.model.granular_temperature = TemperatureModel::of<closures::TemperatureOff>();
    scene.model.thin_layer_arrest = false;
    test::Simulation run(scene);
    run.until(0.4);
    const double angle = inclination * M_PI / 180.0;
    const double block = run.scene.gravity * (std::sin(angle) - mu * std::cos(angle)) * 0.4;
    // what drives it beyond friction is 3.5 % of the weight at 22.5 degrees, and the lowest row lags
    const double share = inclination < 23.0 ? 0.2 : 0.1;
    EXPECT_NEAR(run.now.u_s[0][run.cell(1, 4)], block, share * block) << inclination << " degrees";
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, RoughFloor, ::testing::Values(5e-3, 3e-3, 1e-3, 2e-4));

}  // namespace
}  // namespace granvof
