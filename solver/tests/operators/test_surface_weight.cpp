// A level surface is at rest however it lies in the cells.
#include <span>

#include <gtest/gtest.h>

#include "solver/operators/mixture.hpp"
#include "solver/operators/surface_weight.hpp"
#include "solver/tests/level_surface.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::level_surface;
using test::Tank;

Scene inclined_box(double degrees) {
  Scene scene = box_scene(2, {10, 8, 1}, {1.0, 0.8, 1.0});
  scene.inclination = degrees;
  return scene;
}

// Weight on the face below or left of each cell, as a step of pressure [Pa].
FaceField steps(const Tank& tank, const Field& alpha, const SurfaceWeight* weight) {
  const Vec3 g = gravity_of(tank.scene);
  FaceField step(tank.grid);
  for (int d = 0; d < tank.grid.dim; ++d) {
    tank.each(tank.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      step[d][c] = tank.grid.h[d] * g[d] *
                   mixture(0.5 * (alpha[c] + alpha[c - tank.grid.stride(d)]), tank.scene.liquid.density,
                           tank.scene.gas.density);
    });
    if (weight == nullptr) continue;
    for (const auto& [face, force] : (*weight)[d]) step[d][face] += tank.grid.h[d] * force;
  }
  return step;
}

// Largest sum of the steps once round four cells: where it is not zero no pressure is at rest.
double largest_curl(const Tank& tank, const FaceField& step) {
  const std::ptrdiff_t x = tank.grid.stride(0), y = tank.grid.stride(1);
  double largest = 0.0;
  tank.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
    if (i == 0 || j == 0) return;
    largest = std::fmax(largest, std::fabs(step[0][c - y] + step[1][c] - step[0][c] - step[1][c - x]));
  });
  return largest;
}

class LevelSurface : public ::testing::TestWithParam<double> {};

TEST_P(LevelSurface, HasAPressureAtRest) {
  for (const double y : {0.4, 0.425, 0.44, 0.479})
    for (const bool heavy_gas : {false, true}) {
      Scene scene = inclined_box(GetParam());
      if (heavy_gas) scene.liquid.density = 1e-3;
      const Tank tank(scene);
      Field alpha = level_surface(tank.grid, tank.scene, 0.5, y);
      if (heavy_gas)
        for (double& a : std::span(alpha.data(), tank.grid.cells.size)) a = 1.0 - a;
      SurfaceWeight weight(tank.grid, tank.scene, tank.boundary);
      weight.update(alpha);
      const double weight_of_a_cell =
          9.81 * 0.1 * std::fmax(tank.scene.liquid.density, tank.scene.gas.density);
      EXPECT_LT(largest_curl(tank, steps(tank, alpha, &weight)), 1e-12 * weight_of_a_cell) << y << heavy_gas;
    }
}

INSTANTIATE_TEST_SUITE_P(Inclinations, LevelSurface,
                         ::testing::Values(0.0, 0.5, -0.5, 10.0, 30.0, -30.0, 60.0, -75.0, 89.5));

// Without it the mean density has a curl of the order of a cell's weight, but where the level lies along the
// cells.
TEST(SurfaceWeight, IsWhatTheMeanDensityLeavesOut) {
  const auto curl = [](double degrees) {
    const Tank tank(inclined_box(degrees));
    return largest_curl(tank, steps(tank, level_surface(tank.grid, tank.scene, 0.5, 0.44), nullptr));
  };
  EXPECT_LT(curl(0.0), 1e-9);
  EXPECT_GT(curl(30.0), 0.1 * 9.81 * 0.1 * 1000.0);
}

// A thin layer on the floor, a surface just under a lid, a surface over an obstacle: what stands in the way
// is taken for more of the fluid that lies before it.
TEST(SurfaceWeight, ColumnsEndAtWalls) {
  for (const double y : {0.05, 0.13, 0.67, 0.75}) {
    const Tank tank(inclined_box(2.0));
    const Field alpha = level_surface(tank.grid, tank.scene, 0.5, y);
    SurfaceWeight weight(tank.grid, tank.scene, tank.boundary);
    weight.update(alpha);
    EXPECT_LT(largest_curl(tank, steps(tank, alpha, &weight)), 1e-9) << y;
  }
}

// Nothing but at the surface.
TEST(SurfaceWeight, IsThereWhereASurfaceIs) {
  const auto entries = [](const Scene& scene, double y) {
    const Tank tank(scene);
    SurfaceWeight weight(tank.grid, tank.scene, tank.boundary);
    weight.update(level_surface(tank.grid, tank.scene, 0.5, y));
    return weight[0].size() + weight[1].size();
  };
  const Scene box = inclined_box(0.0);
  EXPECT_EQ(entries(box, 0.44), 20u);  // below and above the cells that it cuts
  EXPECT_EQ(entries(box, 2.0), 0u);
}

}  // namespace
}  // namespace granvof
