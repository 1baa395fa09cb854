#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "compare/metrics/fluid_pressure.hpp"

namespace granvof::compare {
namespace {

Scene scene() {
  Scene s;
  s.tank = {0.2, 0.1, 1.0};
  s.gravity = 10.0;
  s.liquid = {1000.0, 1e-3};
  s.solid.diameter = 1e-3;
  s.contact.solid_fraction_min = 0.5;
  s.sides[bottom].inflow.speed = 0.01;
  return s;
}

CellFields fields() {
  CellFields f;
  f.cells = {4, 5, 1};
  f.spacing = {0.05, 0.02, 1.0};
  f.f_s.assign(20, 0.0);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i) f.p_c.push_back(10000.0 * (0.1 - (j + 0.5) * 0.02));
  return f;
}

TEST(HydrostaticDistance, IsZeroAtRestAndFollowsTheInclination) {
  Scene s = scene();
  CellFields f = fields();
  EXPECT_NEAR(hydrostatic_distance(f, s), 0.0, 1e-15);
  f.p_c[7] += 90.0;  // of 900 Pa at the lowest centres
  EXPECT_NEAR(hydrostatic_distance(f, s), 0.1, 1e-12);
  f.p_c[7] -= 90.0;
  s.inclination = 30.0;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i)
      f.p_c[static_cast<std::size_t>(4 * j + i)] =
          1000.0 * (5.0 * ((i + 0.5) * 0.05 - 0.1) +
                    10.0 * std::cos(std::numbers::pi / 6.0) * (0.1 - (j + 0.5) * 0.02));
  EXPECT_NEAR(hydrostatic_distance(f, s), 0.0, 1e-14);
}

// f = 0.5 in the two lower rows: 150 . 0.25 . 1e-3 . 0.01 / (0.125 . 1e-6) + 1.75 . 0.5 . 1000 . 1e-4 /
// (0.125 . 1e-3) = 3000 + 700 Pa/m over 0.02 m: 74 Pa.
TEST(ErgunRatio, IsWhatTheBedTakes) {
  const Scene s = scene();
  CellFields f = fields();
  for (std::size_t c = 0; c < 8; ++c) f.f_s[c] = 0.5;
  for (std::size_t c = 0; c < 4; ++c) f.p_c[c] += 74.0;
  EXPECT_NEAR(ergun_ratio(f, s), 1.0, 1e-12);
  for (std::size_t c = 0; c < 4; ++c) f.p_c[c] += 74.0;
  EXPECT_NEAR(ergun_ratio(f, s), 2.0, 1e-12);
}

}  // namespace
}  // namespace granvof::compare
