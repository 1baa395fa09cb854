// Friction at the free faces of partly filled cells, and how well a flowing bed is solved.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solver/tests/operators/friction_bed.hpp"

namespace granvof {
namespace {

using test::Bed;
using test::box_scene;
using test::Layer;
using test::make_periodic;
using test::step;

class FreeFaces : public ::testing::TestWithParam<std::pair<int, bool>> {
 protected:
  // Every kind of free face, in any place, on contacts of any strength that are sheared at any rate.
  static Scene scene() {
    const auto& [dim, periodic] = GetParam();
    Scene scene = box_scene(dim, {6, 5, dim == 3 ? 4 : 1}, {0.6, 0.4, 0.3}, WallKind::no_slip);
    if (periodic) make_periodic(scene, 0);
    scene.numerics.bed_surface = BedSurface::part_cells;
    return scene;
  }
  static void load(Bed& bed) {
    bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
      bed.rheology.enduring_pressure[c] = std::pow(10.0, bed.s.uniform(0.0, 3.0));
      bed.rheology.kinetic_viscosity[c] = bed.s.uniform(0.0, 10.0);
      bed.rheology.free_side[c] = std::floor(bed.s.uniform(-1.0, 2.0));
      bed.rheology.part_cells.held[c] = bed.s.uniform(0.0, 1.0);  // from free to held
    });
    bed.s.boundary.exchange(bed.rheology.free_side);
    bed.u_strain = bed.s.random_faces(-1.0, 1.0);
    for (int d = 0; d < bed.s.grid.dim; ++d) bed.mass[d].fill(1250.0 / step);
    bed.solve();
  }
};

// Strain and stress leave out the same tilt, or the faces would do work that no edge takes up:
// x . K y = y . K x, and x . K x >= 0 for the stress -K of any velocities.
TEST_P(FreeFaces, StressIsSymmetricAndDissipates) {
  Bed bed(scene());
  load(bed);
  const FaceField x = bed.s.random_faces(-1.0, 1.0), y = bed.s.random_faces(-1.0, 1.0);
  Field kinetic(bed.s.grid);
  const auto work = [&](const FaceField& of, const FaceField& at) {
    return bed.power(of, at, kinetic).on_grains;
  };
  const double xx = work(x, x), yy = work(y, y), xy = work(x, y), yx = work(y, x);
  EXPECT_LT(xx, 0.0);
  EXPECT_LT(yy, 0.0);
  EXPECT_LT(std::fabs(xy), std::sqrt(xx * yy));
  EXPECT_NEAR(xy, yx, 1e-10 * std::sqrt(xx * yy));
}

// All that the stress takes from the grains is dissipated, in contacts and in collisions.
TEST_P(FreeFaces, WhatTheStressTakesIsDissipated) {
  Bed bed(scene());
  load(bed);
  const FaceField x = bed.s.random_faces(-1.0, 1.0);
  Field kinetic(bed.s.grid);
  const Friction::Power power = bed.power(x, x, kinetic);
  EXPECT_NEAR(-power.on_grains, power.friction + power.kinetic, 1e-10 * std::fabs(power.on_grains));
}

INSTANTIATE_TEST_SUITE_P(Boxes, FreeFaces,
                         ::testing::Values(std::pair{2, false}, std::pair{2, true}, std::pair{3, false},
                                           std::pair{3, true}));

// A layer that is driven along x over a no-slip floor (side +1), or under a lid (-1). The grains of its last
// row fill their cells in part, and their free face falls at `fall` [m/s], tilted from cell to cell. Returns
// the speed of each row [m/s].
std::vector<double> driven_rows(int side, bool free, double fall) {
  constexpr int rows = 16, surface = 5;
  Scene scene = side > 0 ? Layer::between(WallKind::no_slip, WallKind::slip)
                         : Layer::between(WallKind::slip, WallKind::no_slip);
  scene.numerics.bed_surface = BedSurface::part_cells;
  Layer layer(scene);
  const auto from_wall = [&](int j) { return side > 0 ? j : rows - 1 - j; };
  layer.s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
    layer.f_s[c] = from_wall(j) <= surface ? 0.5 : 0.0;
    layer.rheology.enduring_pressure[c] = from_wall(j) <= surface ? 100.0 : 0.0;
    if (from_wall(j) != surface) return;
    layer.rheology.free_side[c] = free ? side : 0.0;
    const std::ptrdiff_t face = side > 0 ? c + layer.s.grid.stride(1) : c;
    layer.u_strain[1][face] = -fall * side * (1.0 + 0.5 * (i % 2));
  });
  layer.s.boundary.exchange(layer.rheology.free_side);
  const double mass = 1250.0 / step;
  layer.set(mass, 0.1 * mass);
  layer.solve();
  std::vector<double> speed;
  for (int j = 0; j < rows; ++j)
    if (from_wall(j) <= surface) speed.push_back(layer.u[0][layer.s.grid.cells.index(1, j, 0)]);
  return speed;
}

// At which speed a free face falls is nothing to the bed below: neither its normal strain nor its tilt counts
// for the strain that (17) yields to.
TEST(FrictionOfPartCells, AFallingFreeFaceDoesNotSoftenTheBed) {
  for (const int side : {1, -1}) {
    const auto still = driven_rows(side, true, 0.0), falling = driven_rows(side, true, 0.1),
               taken_for_strain = driven_rows(side, false, 0.1);
    double apart = 0.0;
    for (std::size_t j = 0; j < still.size(); ++j) {
      EXPECT_NEAR(falling[j], still[j], 1e-7 * 0.1) << side << " row " << j;
      apart = std::fmax(apart, std::fabs(taken_for_strain[j] - still[j]));
    }
    EXPECT_GT(apart, 1e-3 * 0.1) << side;  // it would
  }
}

// A free face under falling grains falls as if it had no contacts; with nothing above it the grains below
// hold it.
TEST(FrictionOfPartCells, GrainsThatFallOnAFreeFaceFreeIt) {
  const auto fall = [](double held) {
    Layer layer(Layer::between(WallKind::no_slip, WallKind::slip));
    layer.s.scene.numerics.bed_surface = BedSurface::part_cells;
    Friction friction(layer.s.grid, layer.s.scene, layer.s.boundary);
    constexpr int surface = 5;
    const double mass = 1250.0 / step, speed = -0.1;
    layer.s.each_cell([&](int, int j, int, std::ptrdiff_t c) {
      layer.f_s[c] = j <= surface ? 0.5 : 0.0;
      layer.rheology.enduring_pressure[c] = j <= surface ? 100.0 : 0.0;
      layer.rheology.free_side[c] = j == surface ? 1.0 : 0.0;
      layer.rheology.part_cells.held[c] = held;
      if (j == surface) layer.rhs[1][c + layer.s.grid.stride(1)] = mass * speed;
    });
    layer.set(mass, 0.0);
    layer.fill();
    layer.s.boundary.exchange(layer.rheology.free_side);
    for (int i = 0; i < 6; ++i)
      friction.solve(layer.balance, layer.inertia, layer.aperture, layer.rheology, layer.now, layer.next);
    return layer.u[1][layer.s.grid.cells.index(1, surface + 1, 0)] / speed;
  };
  EXPECT_NEAR(fall(0.0), 1.0, 1e-6);
  EXPECT_LT(fall(1.0), 0.05);
  EXPECT_LT(fall(0.1), 0.5);
}

// Where grains flow, their hold on each other is no excuse: one call meets what many make of it.
TEST(FrictionOfPartCells, AFlowingBedIsSolvedAtOnce) {
  Scene scene = box_scene(2, {40, 16, 1}, {0.2, 0.08, 1.0}, WallKind::no_slip);
  Bed bed(scene);
  bed.s.each_cell([&](int, int j, int, std::ptrdiff_t c) {
    bed.rheology.enduring_pressure[c] = 0.57 * 1500.0 * 9.81 * 0.005 * (15.5 - j);
  });
  bed.u_strain = bed.s.faces({[](const Vec3& x) { return 0.5 * x[1] / 0.08 * std::sin(20.0 * x[0]); },
                              [](const Vec3&) { return 0.0; }, [](const Vec3&) { return 0.0; }});
  bed.s.boundary.fill_velocity(bed.u_strain, Phase::solid);
  for (int d = 0; d < 2; ++d)
    bed.s.each(bed.s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      bed.mass[d][c] = 0.57 * 2500.0 / step;
      bed.rhs[d][c] = bed.mass[d][c] * (bed.u_strain[d][c] + 9.81 * step * bed.s.uniform(-1.0, 1.0));
    });
  bed.fill();
  const auto solve = [&] {
    return bed.friction.solve(bed.balance, bed.inertia, bed.aperture, bed.rheology, bed.now, bed.next);
  };
  EXPECT_TRUE(solve().converged);
  const FaceField once = bed.u;
  for (int i = 0; i < 8; ++i) solve();
  double fastest = 0.0, apart = 0.0;
  for (int d = 0; d < 2; ++d)
    bed.s.each(bed.s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      fastest = std::fmax(fastest, std::fabs(bed.u[d][c]));
      apart = std::fmax(apart, std::fabs(bed.u[d][c] - once[d][c]));
    });
  RecordProperty("apart", std::to_string(apart / fastest * 1e9) + "e-9");
  EXPECT_GT(fastest, 0.1);
  EXPECT_LT(apart, 2e-7 * fastest);
}

}  // namespace
}  // namespace granvof
