// Fields of one instant against what theory knows of them.
#include <gtest/gtest.h>

#include "compare/metrics/known_state.hpp"

namespace granvof::compare {
namespace {

// Two columns of four rows, 0.01 m high, three of them full of grains of 2500 kg/m3 at 0.5 in a gas of 500:
// 100 Pa a row at 10 m/s2.
CellFields column() {
  CellFields f;
  f.cells = {2, 4, 1};
  f.spacing = {0.01, 0.01, 1.0};
  f.f_s = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0};
  f.alpha.assign(8, 0.0);
  f.p_s = {250.0, 250.0, 150.0, 150.0, 70.0, 70.0, 0.0, 0.0};
  f.u_s[1].assign(8, -0.25);
  f.u_c[1].assign(8, 0.5);
  return f;
}

Scene scene() {
  Scene s;
  s.gravity = 10.0;
  s.gas.density = 500.0;
  s.liquid.density = 1000.0;
  s.solid.density = 2500.0;
  s.contact.solid_fraction_min = 0.5;
  return s;
}

TEST(WeightDistance, IsOfTheRowsBelowTheSurface) {
  CellFields f = column();
  EXPECT_NEAR(*weight_distance(f, scene()), 0.0, 1e-15);
  f.p_s[1] = 225.0;
  EXPECT_NEAR(*weight_distance(f, scene()), 0.1, 1e-12);
  f = column();
  f.alpha.assign(8, 1.0);  // 75 Pa a row
  EXPECT_NEAR(*weight_distance(f, scene()), 62.5 / 187.5, 1e-12);
  f.f_s.assign(8, 0.0);
  EXPECT_FALSE(weight_distance(f, scene()));
  f = column();
  f.p_s.clear();
  EXPECT_FALSE(weight_distance(f, scene()));
}

TEST(MeanSolidPressure, IsOfTheCellsWithGrains) {
  EXPECT_NEAR(*mean_solid_pressure(column()), 470.0 / 3.0, 1e-12);
  EXPECT_FALSE(mean_solid_pressure(CellFields{}));
}

TEST(SlipInTheMiddle, IsOfTheRowAtMidHeight) {
  CellFields f = column();
  f.u_c[1][4] = 0.25;
  EXPECT_NEAR(*slip_in_the_middle(f), 0.625, 1e-15);
  f.f_s[5] = 0.0;
  EXPECT_FALSE(slip_in_the_middle(f));
}

TEST(MirrorDistance, IsTheLargestOfGrainsAndLiquid) {
  CellFields f = column();
  EXPECT_EQ(mirror_distance(f), 0.0);
  f.f_s[3] = 0.25;
  EXPECT_EQ(mirror_distance(f), 0.25);
  f.alpha[7] = 0.5;
  EXPECT_EQ(mirror_distance(f), 0.5);
}

}  // namespace
}  // namespace granvof::compare
