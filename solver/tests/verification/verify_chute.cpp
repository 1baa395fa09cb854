// A layer that runs down a slope: mu(I) of the whole stress, against its own profile.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

constexpr double thickness = 0.04, packing = 0.6,
                 rough = 0.4;  // [m], of the bed as it is set up [-], mu_s [-]

// 4 cm of grains of 1 mm in air, 2.5 mm high cells.
std::string chute(double degrees) {
  return fmt::format(
      "[scene]\nname = \"chute\"\n[tank]\nsize = [0.02, 0.06]\ninclination = {}\n[grid]\ndx = 0.005\ndy = "
      "0.0025\n[walls]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"no-slip\"\ntop = \"open\"\n"
      "[gas]\ndensity = 1.2\nviscosity = 1.8e-5\n[solid]\ndensity = 2500\ndiameter = 1e-3\nfriction = {}\n"
      "[bed]\nlength = 0.02\nheight = {}\nsolid_fraction = {}\n[model]\npreset = \"advised\"\n"
      "whole_stress_friction = true\n[time]\nend = 100\n",
      degrees, rough, thickness, packing);
}

// Speed of the surface [m/s] where tau / P = mu(I) = tan(slope) all over: Bagnold's profile, as GDR MiDi,
// Eur. Phys. J. E 14 (2004) 341, has it: u = 2/3 I / d sqrt(f_s g cos) h^(3/2).
double by_theory(const Scene& scene, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, slope = std::tan(angle);
  const double inertial =
      scene.contact.inertial_number * (slope - rough) / (scene.contact.fast_friction - slope);
  return 2.0 / 3.0 * inertial / scene.solid.diameter * std::sqrt(packing * scene.gravity * std::cos(angle)) *
         std::pow(thickness, 1.5);
}

class Chute : public ::testing::TestWithParam<int> {};

// Collisions bear 0.16 to all of the weight here. Without model.whole_stress_friction their stress comes on
// top of mu(I), and the surface runs at 0.64, 0.43 and 0.28 of that speed.
TEST_P(Chute, RunsAtTheSpeedOfItsFriction) {
  const double degrees = GetParam();
  Simulation run(parse_scene(chute(degrees), "chute", {}));
  run.until(16.0);
  if (HasFatalFailure()) return;
  const int top = static_cast<int>(thickness / run.grid.h[1]) - 1;
  const double speed = run.now.u_s[0][run.cell(0, top)], theory = by_theory(run.scene, degrees);
  report("speed", speed);
  report("of_theory", speed / theory);
  report("steps", run.steps);
  EXPECT_NEAR(speed, theory, 0.03 * theory);
}

INSTANTIATE_TEST_SUITE_P(Slopes, Chute, ::testing::Values(24, 26, 28),
                         [](const auto& slope) { return fmt::format("{}_degrees", slope.param); });

}  // namespace
}  // namespace granvof::test
