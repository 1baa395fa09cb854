// What each kind of side answers, what its ghosts are, and what obstacles close.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/operators/aperture.hpp"
#include "solver/operators/strain.hpp"
#include "solver/scene/gravity.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

Scene box() {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0});
  scene.gravity = 10.0;
  return scene;
}

TEST(SideRule, AWallIsClosed) {
  Side side;
  side.velocity = {0.5, 0.0, 0.0};
  side.solid = {WallKind::coulomb, 0.3};
  const SideRule rule = wall_rule(side);
  EXPECT_FALSE(rule.is_open());
  EXPECT_TRUE(rule.bears_grains);
  EXPECT_EQ(rule.fluid.share, -1.0);
  EXPECT_EQ(rule.fluid.shift[0], 1.0);
  EXPECT_EQ(rule.grains.share, 1.0);  // Coulomb's stress is the friction operator's
  EXPECT_EQ(rule.friction, 0.3);
  side.solid = {WallKind::no_slip, 0.0};
  EXPECT_TRUE(std::isinf(wall_rule(side).friction));
}

TEST(SideRule, AnOpenTopIsAtTheWeightOfTheGasOutside) {
  Scene scene = box();
  scene.sides[top].kind = SideKind::open;
  EXPECT_FALSE(open_top_rule(scene).pressure);
  scene.inclination = 30.0;
  const SideRule rule = open_top_rule(scene);
  EXPECT_NEAR(rule.pressure({0.4, 0.3, 0.0}), 1.0 * 5.0 * 0.2, 1e-14);
  EXPECT_NEAR(rule.pressure({0.2, 0.3, 0.0}), 0.0, 1e-14);
  EXPECT_FALSE(rule.passes_grains || rule.bears_grains);
  EXPECT_EQ(rule.liquid_share, 0.0);
}

TEST(SideRule, AnOutletHasThePressureOfItsLevel) {
  Scene scene = box();
  scene.sides[right].kind = SideKind::outlet;
  scene.sides[right].outflow = {7.0, 0.2};
  const SideRule rule = outlet_rule(scene, right);
  EXPECT_NEAR(rule.pressure({0.4, 0.3, 0.0}), 7.0, 1e-12);
  EXPECT_NEAR(rule.pressure({0.4, 0.25, 0.0}), 7.0 + 1.0 * 10.0 * 0.05, 1e-12);
  EXPECT_NEAR(rule.pressure({0.4, 0.05, 0.0}), 7.0 + 1.0 * 10.0 * 0.1 + 1000.0 * 10.0 * 0.15, 1e-9);
  EXPECT_TRUE(rule.passes_grains);
  EXPECT_FALSE(rule.liquid_share);
  scene.sides[right].outflow.level = 0.3;
  EXPECT_EQ(outlet_rule(scene, right).liquid_share, 1.0);
}

// In the floor of an inclined tank, where the weight along it counts from its middle.
TEST(SideRule, AnOutletInTheFloorOfAnInclinedTankHasThePressureAlongIt) {
  Scene scene = box();
  scene.inclination = 30.0;
  scene.sides[bottom].kind = SideKind::outlet;
  scene.sides[bottom].outflow = {7.0, 0.2};
  const SideRule rule = outlet_rule(scene, bottom);
  const double rest = 7.0 + std::sqrt(75.0) * (1.0 * 0.1 + 1000.0 * 0.2);
  EXPECT_NEAR(rule.pressure({0.2, 0.0, 0.0}), rest, 1e-9);
  EXPECT_NEAR(rule.pressure({0.4, 0.0, 0.0}), rest + 1000.0 * 5.0 * 0.2, 1e-9);
  scene.sides[bottom].outflow.level = 0.0;  // gas beyond
  EXPECT_NEAR(outlet_rule(scene, bottom).pressure({0.4, 0.0, 0.0}),
              7.0 + std::sqrt(75.0) * 0.3 + 1.0 * 5.0 * 0.2, 1e-9);
  EXPECT_EQ(outlet_rule(scene, bottom).liquid_share, 0.0);
}

TEST(SideRule, AnInletWithoutGrainsIsAWallToThem) {
  const SideRule water = inlet_rule({0.5, 0.0, 1.0}), mixture = inlet_rule({0.5, 0.2, 1.0});
  EXPECT_EQ(water.inflow(Phase::fluid), 0.5);
  EXPECT_EQ(water.inflow(Phase::solid), 0.0);
  EXPECT_TRUE(water.bears_grains);
  EXPECT_EQ(water.grains.share, 1.0);  // on which they slip
  EXPECT_EQ(mixture.inflow(Phase::solid), 0.5);
  EXPECT_FALSE(mixture.bears_grains);
  EXPECT_EQ(mixture.grains.share, 0.0);
  EXPECT_EQ(mixture.fluid.share, 0.0);  // nothing moves along it
}

TEST(SideRule, BumpsAreInRadians) {
  Side side;
  side.solid.kind = WallKind::bumpy;
  side.solid.bumpiness = 45.0;
  side.solid.restitution = 0.8;
  ASSERT_TRUE(wall_rule(side).bumps);
  EXPECT_NEAR(wall_rule(side).bumps->angle, std::numbers::pi / 4.0, 1e-15);
  EXPECT_EQ(wall_rule(side).bumps->restitution, 0.8);
}

// u_c and u_s come in at the speed given, with what comes in beyond; at the other end they go on.
TEST(Boundary, AnInletAndAnOutlet) {
  Scene scene = box();
  scene.sides[left].kind = SideKind::inlet;
  scene.sides[left].inflow = {0.5, 0.2, 0.75};
  scene.sides[right].kind = SideKind::outlet;
  scene.sides[right].outflow = {7.0, 0.0};
  const Tank s(scene);
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  EXPECT_EQ(s.grid.flux_faces(0).lower[0], 0);
  EXPECT_EQ(s.grid.flux_faces(0).upper[0], 5);
  EXPECT_EQ(s.grid.fluid_faces(0).lower[0], 1);
  EXPECT_EQ(s.grid.fluid_faces(0).upper[0], 5);
  EXPECT_FALSE(s.grid.sealed() || s.grid.has_whole_columns());

  Field f(s.grid, 0.3), a(s.grid, 0.4), p(s.grid, 2.0), dp(s.grid, 2.0);
  s.boundary.fill_solid_fraction(f);
  s.boundary.fill_liquid_share(a);
  s.boundary.fill_pressure(p);
  s.boundary.fill_pressure_increment(dp);
  EXPECT_EQ(f[at(-1, 1)], 0.2);
  EXPECT_EQ(f[at(4, 1)], 0.3);
  EXPECT_EQ(a[at(-2, 1)], 0.75);
  EXPECT_EQ(a[at(4, 1)], 0.0);  // beyond the outlet stands gas
  EXPECT_EQ(a[at(5, 1)], 0.0);
  EXPECT_EQ(p[at(-1, 1)], 2.0);
  EXPECT_NEAR(p[at(4, 1)], 2.0 * (7.0 + 10.0 * 0.15) - 2.0, 1e-12);  // gas over the middle row
  EXPECT_EQ(dp[at(4, 1)], -2.0);

  for (const Phase phase : {Phase::fluid, Phase::solid}) {
    FaceField u(s.grid);
    s.each(s.grid.all_faces(0), [&](int i, int, int, std::ptrdiff_t c) { u[0][c] = 0.1 * i - 0.2; });
    s.each(s.grid.inner_faces(1), [&](int, int, int, std::ptrdiff_t c) { u[1][c] = 1.0; });
    s.boundary.fill_velocity(u, phase);
    EXPECT_EQ(u[0][at(0, 1)], 0.5);
    EXPECT_EQ(u[0][at(-1, 1)], 0.5);
    EXPECT_EQ(u[1][at(-1, 1)], 0.0);
    EXPECT_EQ(u[1][at(4, 1)], 1.0);
    // the fluid's is an unknown, grains take that of the face before
    EXPECT_NEAR(u[0][at(4, 1)], phase == Phase::fluid ? 0.2 : 0.1, 1e-15);
    u[0][at(3, 1)] = -0.1;
    s.boundary.fill_velocity(u, phase);
    if (phase == Phase::solid) {
      EXPECT_EQ(u[0][at(4, 1)], 0.0);  // and none come in
    }
  }
}

// Rows of 0.1 m: what flows back is liquid up to the level of either outlet; what leaves is as inside.
TEST(Boundary, WhatFlowsBackLiesBeyondThatOutlet) {
  Scene scene = box();
  for (const auto& [side, level] : {std::pair{left, 0.25}, std::pair{right, 0.1}}) {
    scene.sides[side].kind = SideKind::outlet;
    scene.sides[side].outflow = {0.0, level};
  }
  const Tank s(scene);
  const auto beyond = [&](double inward) {
    Field a(s.grid, 0.4);
    FaceField q(s.grid);
    for (int j = 0; j < 3; ++j) {
      q[0][s.grid.cells.index(0, j, 0)] = inward;
      q[0][s.grid.cells.index(4, j, 0)] = -inward;
    }
    s.boundary.fill_liquid_share(a, q);
    std::array<double, 6> rows{};
    for (int j = 0; j < 3; ++j) {
      rows[j] = a[s.grid.cells.index(-1, j, 0)];
      rows[3 + j] = a[s.grid.cells.index(5, j, 0)];
    }
    return rows;
  };
  const std::array<double, 6> levels{1.0, 1.0, 0.5, 1.0, 0.0, 0.0};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(beyond(0.1)[i], levels[i], 1e-12) << i;
    EXPECT_EQ(beyond(-0.1)[i], 0.4) << i;
  }
}

TEST(Boundary, AnInletWithoutGrainsIsAWallToThem) {
  Scene scene = box();
  scene.sides[bottom].kind = SideKind::inlet;
  scene.sides[bottom].inflow = {0.5, 0.0, 1.0};
  scene.sides[top].kind = SideKind::open;
  const Tank s(scene);
  EXPECT_TRUE(s.grid.side(1, false).bears_grains);
  FaceField u(s.grid);
  s.each(s.grid.inner_faces(1), [&](int, int, int, std::ptrdiff_t c) { u[1][c] = 0.1; });
  s.boundary.fill_velocity(u, Phase::solid);
  EXPECT_EQ(u[1][s.grid.cells.index(1, 0, 0)], 0.0);
  EXPECT_EQ(u[1][s.grid.cells.index(1, -1, 0)], -0.1);
}

// A box of 2 x 1 cells on the floor of 4 x 3.
Scene with_box() {
  Scene scene = box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0}, WallKind::no_slip);
  scene.obstacles = {{{0.1, 0.0, 0.0}, {0.3, 0.1, 1.0}}};
  return scene;
}

TEST(Obstacles, CloseTheFacesOfTheirCells) {
  const Tank s(with_box());
  const Aperture aperture(s.grid, s.scene);
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  EXPECT_EQ(s.grid.obstacles.cells().size(), 2U);
  for (const int i : {1, 2, 3}) EXPECT_EQ(aperture[0][at(i, 0)], 0.0);
  for (const int i : {1, 2}) EXPECT_EQ(aperture[1][at(i, 1)], 0.0);
  EXPECT_EQ(aperture[0][at(1, 1)], 1.0);
  EXPECT_EQ(aperture[1][at(0, 1)], 1.0);
  EXPECT_EQ(s.grid.obstacles.faces(0).size(), 3U);
}

TEST(Obstacles, AreHalfACellFromTheVelocityBeside) {
  const Tank s(with_box());
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  int flat = 0;
  for (const Obstacles::Edge& edge : s.grid.obstacles.edges(0)) {
    if (!edge.flat) continue;
    ++flat;
    EXPECT_EQ(edge.at, at(2, 1));
    EXPECT_EQ(edge.cells, 2);
    EXPECT_EQ(edge.face[0], (std::pair<int, std::ptrdiff_t>(0, at(2, 1))));
  }
  EXPECT_EQ(flat, 1);  // the edge in the middle of its upper face; two are corners
  FaceField u(s.grid);
  u[0][at(2, 1)] = 0.5;
  u[0][at(1, 1)] = 0.5;
  StrainRate strain(s.grid);
  strain.update(s.grid, s.boundary.walls(), u);
  EXPECT_NEAR(strain.shear[0][at(2, 1)], 2.0 * 0.5 / 0.1, 1e-12);
  EXPECT_NEAR(strain.shear[0][at(1, 1)], 0.5 / 0.1, 1e-12);  // at the corner: the whole cell
}

TEST(Obstacles, ExtendWhatIsBeside) {
  const Tank s(with_box());
  const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
  Field f(s.grid);
  f[at(0, 0)] = 1.0;
  f[at(1, 1)] = 3.0;
  f[at(2, 1)] = 5.0;
  f[at(3, 0)] = 9.0;
  s.grid.obstacles.extend(f.data());
  EXPECT_EQ(f[at(1, 0)], 2.0);
  EXPECT_EQ(f[at(2, 0)], 7.0);
}

TEST(Gravity, FollowsTheInclination) {
  Scene scene = box();
  EXPECT_EQ(gravity_of(scene), (Vec3{0.0, -10.0, 0.0}));
  scene.inclination = 30.0;
  EXPECT_NEAR(gravity_of(scene)[0], 5.0, 1e-14);
  EXPECT_NEAR(normal_gravity(scene), 10.0 * std::sqrt(0.75), 1e-14);
  test::make_periodic(scene, 0);
  EXPECT_EQ(confined_gravity(scene)[0], 0.0);
  EXPECT_NE(confined_gravity(scene)[1], 0.0);
}

}  // namespace
}  // namespace granvof
