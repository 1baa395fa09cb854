// Where thin layers stop: on a rough floor, by the thickness of the bed that lies on it.
#include <array>

#include <gtest/gtest.h>

#include "solver/closures/contact_friction.hpp"
#include "solver/operators/thin_layer.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

constexpr int rows = 6;
constexpr double h = 0.002;  // [m]

// Columns all alike: solid fractions from the floor up.
std::array<double, rows> friction_of(const std::array<double, rows>& fractions, WallKind floor) {
  const Tank s(box_scene(2, {4, rows, 1}, {4 * h, rows * h, 1.0}, floor));
  Field f(s.grid), friction(s.grid);
  s.each_cell([&](int, int j, int, std::ptrdiff_t c) { f[c] = fractions[static_cast<std::size_t>(j)]; });
  arrest_thin_layers(s.grid, s.scene, f, friction);
  std::array<double, rows> column{};
  for (int j = 0; j < rows; ++j) column[static_cast<std::size_t>(j)] = friction[s.grid.cells.index(2, j, 0)];
  return column;
}

double stop(const Scene& scene, double thickness) {
  return closures::arrest_friction(thickness, scene.solid.friction, scene.contact.fast_friction,
                                   scene.contact.stop_length, scene.solid.diameter);
}

TEST(ThinLayer, ThicknessIsThatOfTheBedOnTheFloor) {
  const Scene scene = box_scene(2, {4, rows, 1}, {4 * h, rows * h, 1.0});
  const auto column = friction_of({0.57, 0.57, 0.30, 0.1, 0.5, 0.0}, WallKind::no_slip);
  const double expected = stop(scene, (2.0 + 0.30 / 0.57) * h);
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(column[static_cast<std::size_t>(j)], expected, 1e-12) << j;
  for (int j = 3; j < rows; ++j) EXPECT_EQ(column[static_cast<std::size_t>(j)], 0.0) << j;
  EXPECT_GT(expected, scene.solid.friction);
}

TEST(ThinLayer, ThinnerStopsOnSteeperSlopes) {
  const auto one = friction_of({0.57, 0, 0, 0, 0, 0}, WallKind::no_slip);
  const auto three = friction_of({0.57, 0.57, 0.57, 0, 0, 0}, WallKind::no_slip);
  EXPECT_GT(one[0], three[0]);
}

TEST(ThinLayer, NothingWithoutBedOrRoughFloor) {
  for (const double f : friction_of({0.2, 0.57, 0.57, 0, 0, 0}, WallKind::no_slip)) EXPECT_EQ(f, 0.0);
  for (const double f : friction_of({0.57, 0.57, 0, 0, 0, 0}, WallKind::slip)) EXPECT_EQ(f, 0.0);
  for (const double f : friction_of({0.57, 0.57, 0, 0, 0, 0}, WallKind::coulomb)) EXPECT_EQ(f, 0.0);
}

}  // namespace
}  // namespace granvof
