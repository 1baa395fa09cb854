// Index ranges of the staggered grid, ghost values at every kind of side, and the faces the gate closes.
#include <gtest/gtest.h>

#include "solver/operators/aperture.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::make_periodic;
using test::Tank;

void expect_range(const Range& r, std::array<int, 3> lower, std::array<int, 3> upper) {
  EXPECT_EQ(r.lower, lower);
  EXPECT_EQ(r.upper, upper);
}

TEST(Grid, RangesOfAClosedBox) {
  const Tank s(box_scene(2, {5, 3, 1}, {0.5, 0.6, 0.1}));
  EXPECT_DOUBLE_EQ(s.grid.cell_volume, 0.1 * 0.2 * 0.1);
  expect_range(s.grid.all_cells(), {0, 0, 0}, {5, 3, 1});
  expect_range(s.grid.inner_faces(0), {1, 0, 0}, {5, 3, 1});
  expect_range(s.grid.inner_faces(1), {0, 1, 0}, {5, 3, 1});
  expect_range(s.grid.fluid_faces(1), {0, 1, 0}, {5, 3, 1});
  expect_range(s.grid.all_faces(0), {0, 0, 0}, {6, 3, 1});
  expect_range(s.grid.edges(0, 1), {0, 0, 0}, {6, 4, 1});
  expect_range(s.grid.cells_and_ghosts(2), {-2, -2, 0}, {7, 5, 1});
}

TEST(Grid, RangesOfAnOpenTopAndPeriodicSides) {
  Scene scene = box_scene(3, {5, 3, 4}, {0.5, 0.6, 0.4});
  scene.sides[top].kind = SideKind::open;
  make_periodic(scene, 2);
  const Tank s(scene);
  EXPECT_FALSE(s.grid.sealed());
  EXPECT_TRUE(s.grid.has_whole_columns());
  expect_range(s.grid.inner_faces(1), {0, 1, 0}, {5, 3, 4});
  expect_range(s.grid.fluid_faces(1), {0, 1, 0}, {5, 4, 4});
  expect_range(s.grid.inner_faces(2), {0, 0, 0}, {5, 3, 4});
  expect_range(s.grid.cells_and_ghosts(1), {-1, -1, -1}, {6, 4, 5});
}

TEST(Grid, LoopsSeeEveryValueOnceAlsoInParallel) {
  const Tank s(box_scene(2, {150, 100, 1}, {1.0, 1.0, 1.0}));  // enough for threads
  Field f(s.grid);
  for_each(s.grid.cells, [&](std::ptrdiff_t c) { f[c] += 1.0; });
  EXPECT_EQ(s.total(f), 15000.0);
  EXPECT_EQ(sum_over(s.grid.cells, s.grid.all_cells(), [&](std::ptrdiff_t c) { return f[c]; }), 15000.0);
  f[s.grid.cells.index(149, 99, 0)] = 3.0;
  const auto value = [&](std::ptrdiff_t c) { return f[c]; };
  EXPECT_EQ(max_over(s.grid.cells, s.grid.all_cells(), 0.0, value), 3.0);
  f[s.grid.cells.index(17, 4, 0)] = NAN;
  EXPECT_TRUE(std::isnan(max_over(s.grid.cells, s.grid.all_cells(), 0.0, value)));
  EXPECT_TRUE(everywhere(s.grid.cells, true));
  EXPECT_FALSE(everywhere(s.grid.cells, false));
}

TEST(Boundary, ScalarsAreMirroredOrTakeTheOpenTopsValue) {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0});
  scene.sides[top].kind = SideKind::open;
  const Tank s(scene);
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  Field f(s.grid, -99.0);
  s.each_cell([&](int i, int j, int, std::ptrdiff_t c) { f[c] = 1.0 + i + 10.0 * j; });
  s.boundary.fill_scalar(f, 0.5);
  for (int j = 0; j < 3; ++j)
    for (int g = 1; g <= 2; ++g) {
      EXPECT_EQ(f[at(-g, j)], f[at(0, j)]);
      EXPECT_EQ(f[at(3 + g, j)], f[at(3, j)]);
    }
  for (int i = -2; i < 6; ++i) {
    EXPECT_EQ(f[at(i, -1)], f[at(std::clamp(i, 0, 3), 0)]) << i;  // corners included
    EXPECT_EQ(f[at(i, 3)], 0.5) << i;
    EXPECT_EQ(f[at(i, 4)], 0.5) << i;
  }
  s.boundary.fill_scalar(f);
  EXPECT_EQ(f[at(2, 3)], f[at(2, 2)]);
  s.boundary.fill_pressure(f);
  EXPECT_EQ(f[at(2, 3)], -f[at(2, 2)]);  // zero on the top itself
  EXPECT_EQ(f[at(2, -1)], f[at(2, 0)]);
  EXPECT_EQ(f[at(4, 1)], f[at(3, 1)]);
}

TEST(Boundary, PeriodicSidesAreJoinedCornersIncluded) {
  for (const std::array<int, 3> n : {std::array{4, 3, 1}, std::array{1, 3, 1}}) {
    Scene scene = box_scene(2, n, {0.4, 0.3, 1.0});
    make_periodic(scene, 0);
    make_periodic(scene, 1);
    const Tank s(scene);
    const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
    Field f(s.grid, -99.0);
    s.each_cell([&](int i, int j, int, std::ptrdiff_t c) { f[c] = 1.0 + i + 10.0 * j; });
    s.boundary.fill_scalar(f, 7.0);
    for (int j = -2; j < n[1] + 2; ++j)
      for (int i = -2; i < n[0] + 2; ++i)
        EXPECT_EQ(f[at(i, j)], 1.0 + (i + 2 * n[0]) % n[0] + 10.0 * ((j + n[1]) % n[1])) << i << ' ' << j;
  }
}

TEST(Boundary, VelocityAtNoSlipSlipAndMovingWalls) {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0}, WallKind::no_slip);
  scene.sides[top].velocity = {0.7, 0.0, 0.0};
  scene.sides[left].fluid.kind = WallKind::slip;
  scene.sides[right].solid.kind = WallKind::coulomb;
  const Tank s(scene);
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  for (const Phase phase : {Phase::fluid, Phase::solid}) {
    FaceField u(s.grid, 3.0);
    s.each(s.grid.all_cells(), [&](int i, int j, int, std::ptrdiff_t c) {
      u[0][c] = 1.0 + i + 0.1 * j;
      u[1][c] = -2.0 - i + 0.3 * j;
    });
    s.boundary.fill_velocity(u, phase);
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(u[0][at(0, j)], 0.0);
      EXPECT_EQ(u[0][at(4, j)], 0.0);
      EXPECT_EQ(u[0][at(-1, j)], -u[0][at(1, j)]);
      EXPECT_EQ(u[0][at(-2, j)], -u[0][at(2, j)]);
      EXPECT_EQ(u[0][at(5, j)], -u[0][at(3, j)]);
    }
    for (int i = 0; i <= 4; ++i) {
      EXPECT_DOUBLE_EQ(0.5 * (u[0][at(i, 3)] + u[0][at(i, 2)]), 0.7);  // the moving lid
      EXPECT_DOUBLE_EQ(0.5 * (u[0][at(i, -1)] + u[0][at(i, 0)]), 0.0);
    }
    const double left_sign = phase == Phase::fluid ? 1.0 : -1.0, right_sign = -left_sign;
    for (int j = 1; j < 3; ++j) {
      EXPECT_EQ(u[1][at(-1, j)], left_sign * u[1][at(0, j)]);
      EXPECT_EQ(u[1][at(4, j)], right_sign * u[1][at(3, j)]);
    }
    for (int i = -2; i < 6; ++i) EXPECT_EQ(u[1][at(i, 0)], 0.0) << i;  // corners included
  }
}

TEST(Boundary, FluidPassesAnOpenTopAndGrainsDoNot) {
  Scene scene = box_scene(2, {3, 3, 1}, {0.3, 0.3, 1.0}, WallKind::no_slip);
  scene.sides[top].kind = SideKind::open;
  const Tank s(scene);
  const std::ptrdiff_t face = s.grid.cells.index(1, 3, 0), above = s.grid.cells.index(1, 4, 0);
  FaceField u(s.grid, 2.0);
  s.boundary.fill_velocity(u, Phase::fluid);
  EXPECT_EQ(u[1][face], 2.0);
  EXPECT_EQ(u[1][above], 2.0);
  EXPECT_EQ(u[0][s.grid.cells.index(1, 3, 0)], 2.0);  // no shear on the open top
  s.boundary.fill_velocity(u, Phase::solid);
  EXPECT_EQ(u[1][face], 0.0);
}

TEST(Boundary, OneCellBetweenClosedSidesIsAtRestAcross) {
  const Tank s(box_scene(2, {1, 3, 1}, {0.1, 0.3, 1.0}));
  FaceField u(s.grid, 7.0);
  s.boundary.fill_velocity(u, Phase::fluid);
  for (int i = -2; i <= 2; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(u[0][s.grid.cells.index(i, j, 0)], 0.0) << i;
}

TEST(Aperture, ClosedSidesAreClosedAndOthersOpen) {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0});
  scene.sides[top].kind = SideKind::open;
  const Tank s(scene);
  Aperture aperture(s.grid, s.scene);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= 4; ++i)
      EXPECT_EQ(aperture[0][s.grid.cells.index(i, j, 0)], i == 0 || i == 4 ? 0.0 : 1.0);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j <= 3; ++j) EXPECT_EQ(aperture[1][s.grid.cells.index(i, j, 0)], j == 0 ? 0.0 : 1.0);
  EXPECT_FALSE(aperture.update(1.0));  // no gate, nothing moves
}

TEST(Aperture, PeriodicFacesAreOpenOnBothEnds) {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0});
  make_periodic(scene, 0);
  const Tank s(scene);
  const Aperture aperture(s.grid, s.scene);
  for (int i : {0, 4}) EXPECT_EQ(aperture[0][s.grid.cells.index(i, 1, 0)], 1.0);
}

TEST(Aperture, GateOpensRowByRow) {
  Scene scene = box_scene(2, {20, 8, 1}, {0.2, 0.08, 1.0});
  scene.gate = Gate{0.104, 2.0};  // nearest face: 10
  const Tank s(scene);
  Aperture aperture(s.grid, s.scene);
  const auto open_rows = [&] {
    int rows = 0;
    for (int j = 0; j < 8; ++j) {
      const double open = aperture[0][s.grid.cells.index(10, j, 0)];
      if (open == 1.0) {
        EXPECT_EQ(rows, j) << "rows open from below";
      }
      rows += static_cast<int>(open);
      for (int i : {9, 11}) EXPECT_EQ(aperture[0][s.grid.cells.index(i, j, 0)], 1.0);
    }
    return rows;
  };
  EXPECT_EQ(open_rows(), 0);
  EXPECT_FALSE(aperture.update(0.0));
  // edge 2 t: passes the centre of row j at (j + 0.5) * 0.01 / 2
  EXPECT_FALSE(aperture.update(0.0024));
  EXPECT_TRUE(aperture.update(0.0026));
  EXPECT_EQ(open_rows(), 1);
  EXPECT_FALSE(aperture.update(0.0074));
  EXPECT_TRUE(aperture.update(0.0176));
  EXPECT_EQ(open_rows(), 4);
  EXPECT_TRUE(aperture.update(10.0));
  EXPECT_EQ(open_rows(), 8);
  EXPECT_TRUE(aperture.update(-0.1));  // before the release it stands again
  EXPECT_EQ(open_rows(), 0);
}

TEST(Aperture, GateFaceIsTheNearestOne) {
  for (const auto& [position, face] : {std::pair{0.106, 11}, std::pair{0.1, 10}, std::pair{0.001, 1}}) {
    Scene scene = box_scene(2, {20, 8, 1}, {0.2, 0.08, 1.0});
    scene.gate = Gate{position, 1.0};
    const Tank s(scene);
    const Aperture aperture(s.grid, s.scene);
    for (int i = 1; i < 20; ++i) EXPECT_EQ(aperture[0][s.grid.cells.index(i, 3, 0)], i == face ? 0.0 : 1.0);
  }
}

}  // namespace
}  // namespace granvof
