// Laws of states without gradients as printed, against numbers worked out by hand.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compare/checks/homogeneous.hpp"
#include "compare/checks/theory.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

Scene even(const char* name, const std::vector<std::string>& overrides = {}) {
  return load_scene(cases_directory() / "even" / (std::string(name) + ".toml"), overrides);
}

// f_s 0.1, slip 0.1 m/s, water: Re = 80, C_D Re = 24 + 480 / (1 + sqrt 80) + 32 = 104.269; 0.75 . 104.269 .
// 1e-3 . 0.1 / 6.4e-7 . 0.9^-1.65 = 14539 kg/m3 s.
TEST(PrintedDrag, IsThatOfItsSource) {
  EXPECT_NEAR(printed_drag(even("settling"), 0.1, 0.1), 14539.0, 1.0);
  // 150 . 0.16 . 1e-3 / (0.6 . 6.4e-7) + 1.75 . 1000 . 0.4 . 0.1 / 8e-4 = 62500 + 87500
  EXPECT_NEAR(printed_drag(even("settling"), 0.4, 0.1), 150000.0, 1e-6);
  // half way from one to the other: at rest 0.2 of 150 . 0.04 . 1e-3 / (0.8 . 6.4e-7) = 11718.75 and 18 .
  // 1e-3 . 0.2 / 6.4e-7 . 0.8^-1.65 = 8129
  EXPECT_NEAR(printed_drag(even("settling"), 0.2, 0.0), 9924.0, 1.0);
  // Stokes' force of the lone grain, 18 mu f_s / d2, by every law; Dallavalle's is 4 % less.
  for (const char* law : {"paper", "beetstra", "tenneti", "di-felice"}) {
    const Scene scene = even("settling", {std::string("model.drag_law=") + law});
    const double share = law == std::string("di-felice") ? 4.8 * 4.8 / 24.0 : 1.0;
    EXPECT_NEAR(printed_drag(scene, 1e-9, 0.0) / (18e-3 * 1e-9 / 6.4e-7), share, 2e-3) << law;
  }
}

TEST(PrintedSettling, BalancesWeightAndDrag) {
  const Scene scene = even("settling");
  const double slip = *printed_settling_slip(scene);
  EXPECT_NEAR(printed_drag(scene, 0.1, slip) * slip, 0.1 * 0.9 * 1500.0 * 9.81, 1e-9);
  EXPECT_FALSE(printed_settling_slip(even("settling", {"bed=false", "solid=false"})));
}

// Smooth grains of e = 0.8 without a fluid: Theta = d^2 gamma^2 / (15 (1 - e)) = 1e-6 . 2500 / 3; g0 = 0.825
// / (1 - 0.4 / 0.63)^2 = 6.1898; P = 2500 . 0.4 . Theta (1 + 3.6 . 0.4 . 6.1898) = 8.2606 Pa.
TEST(PrintedEvenShear, OfSmoothGrains) {
  const auto shear = printed_even_shear(even("shear", {"model.drag=false", "gas.viscosity=0"}));
  ASSERT_TRUE(shear);
  EXPECT_NEAR(shear->theta, 2500e-6 / 3.0, 1e-12);
  EXPECT_NEAR(shear->pressure, 8.2606, 1e-3);
  EXPECT_EQ(shear->drag, 0.0);
  // what collisions take is what their viscosity gives: 0.8 . 2500 . 1e-3 . 0.16 . g0 . 1.8 sqrt(Theta / pi)
  // . 2500
  EXPECT_NEAR(shear->contacts,
              0.8 * 2.5 * 0.16 * 6.1898 * 1.8 * std::sqrt(2500e-6 / 3.0 / std::numbers::pi) * 2500.0, 0.01);
  EXPECT_NEAR(shear->energy, 1.5 * 0.4 * 2500.0 * 2500e-6 / 3.0, 1e-12);
}

// (13) at 0.575: 1e8 . 0.575 . 0.005^1.5 (1 + sin(-75 deg)) = 692.75 Pa, friction 0.4, 50 1/s.
TEST(PrintedEvenShear, OfGrainsThatTouch) {
  const std::vector<std::string> still{"bed.solid_fraction=0.575", "model.dilatancy_pressure=false"};
  const auto with = printed_even_shear(even("shear", still));
  ASSERT_TRUE(with);
  const auto g0 = (1.0 - 7.0 * 0.575 / 16.0) / std::pow(1.0 - 0.575 / 0.63, 2);
  EXPECT_GT(with->pressure, 692.7);
  EXPECT_NEAR(with->pressure - 692.75, 2500.0 * 0.575 * with->theta * (1.0 + 2.0 * 1.63 * 0.575 * g0), 10.0);
}

// (15) takes no packing nearer to f_s0 than 0.005; grains set down without weight touch where they are, and
// f_s0 moves with them.
TEST(PrintedEvenShear, OfGrainsNearTheirDensest) {
  const auto dense = [](double gap, double f, double f_s0, double theta) {
    return 15.0 * 2500.0 * theta * (1.0 - 0.63) * std::pow(0.28 * f * f_s0 / gap, 2.0 / 0.58);
  };
  const std::vector<std::string> still{"gas.viscosity=0", "model.drag=false", "solid.restitution=0.63"};
  const auto of = [&](std::vector<std::string> more) {
    more.insert(more.end(), still.begin(), still.end());
    return *printed_even_shear(even("shear", more));
  };
  const EvenShear capped = of({"bed.solid_fraction=0.598", "contact.stiffness=1e-3"});
  EXPECT_NEAR(capped.pressure, dense(0.005, 0.598, 0.6, capped.theta), 1.0);
  const EvenShear carried = of({"bed.solid_fraction=0.59", "model.packing=carried"});
  EXPECT_NEAR(carried.pressure, dense(0.03, 0.59, 0.62, carried.theta), 1e-6 * carried.pressure);
  // (13) at 0.59 where they touch at 0.582: 1e8 . 0.59 . 0.008^1.5 (1 + sin(-66 deg)) = 3649.85 Pa
  const EvenShear critical =
      of({"bed.solid_fraction=0.59", "model.shear_dilatancy=true", "model.dilatancy_pressure=false"});
  const double g0 = (1.0 - 7.0 * 0.59 / 16.0) / std::pow(1.0 - 0.59 / 0.63, 2);
  EXPECT_NEAR(critical.pressure - 2500.0 * 0.59 * critical.theta * (1.0 + 2.0 * 1.63 * 0.59 * g0), 3649.85,
              0.1);
}

TEST(PrintedEvenShear, NeedsMovingWallsAndNoHistory) {
  EXPECT_FALSE(printed_even_shear(even("settling")));
  EXPECT_FALSE(printed_even_shear(even("shear", {"model.correlated_collisions=true"})));
  EXPECT_FALSE(printed_even_shear(even("shear", {"model.whole_stress_friction=true"})));
  EXPECT_FALSE(printed_even_shear(even("shear", {"model.granular_temperature=off"})));
}

double value_of(const char* formula, const Scene& scene, const Parameters& p) {
  Run run;
  run.scene = scene;
  return find_formula(formula)->function(run, p).value_or(-1.0);
}

// g (sin 30 - 0.3 cos 30) 0.2 s = 0.47126 m/s; on a level floor that moves 0.3 g 0.2 s.
TEST(Theory, SpeedOfABlockOnACoulombFloor) {
  Parameters p;
  p.window = {0.0, 0.2};
  EXPECT_NEAR(value_of("sliding_speed", even("sliding"), p), 0.47126, 1e-5);
  EXPECT_NEAR(
      value_of("sliding_speed", even("sliding", {"tank.inclination=0", "walls.bottom.velocity=[2, 0]"}), p),
      0.5886, 1e-12);
  EXPECT_EQ(value_of("sliding_speed", even("settling"), p), -1.0);
}

// Walls give what all others take.
TEST(Theory, PowersOfEvenShear) {
  Parameters p;
  p.window = {0.0, 2.0};
  const Scene scene = even("shear");
  double taken = 0.0;
  for (const char* term : {"contacts", "drag", "viscosity", "walls"}) {
    p.term = term;
    const double power = value_of("even_shear_power", scene, p);
    EXPECT_NE(power, -1.0) << term;
    taken += power;
  }
  EXPECT_NEAR(taken, 0.0, 1e-12);
  p.term = "agitation";
  EXPECT_NEAR(value_of("even_shear_power", scene, p), 0.5 * printed_even_shear(scene)->energy, 1e-15);
  p.term = "released";
  EXPECT_EQ(value_of("even_shear_power", scene, p), -1.0);
}

}  // namespace
}  // namespace granvof::compare
