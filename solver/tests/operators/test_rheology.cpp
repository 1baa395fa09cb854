// Which cells at the surface of a bed have a free face.
#include <gtest/gtest.h>

#include "solver/closures/restitution.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

constexpr int rows = 8;
constexpr double packed = 0.57;

Scene submerged(double density) {
  Scene scene = box_scene(2, {4, rows, 1}, {0.04, 0.08, 1.0});
  scene.numerics.bed_surface = BedSurface::part_cells;
  scene.solid.density = density;
  return scene;
}

// free_side of each row, from the floor up, of columns that are all alike; theta [m2/s2], p_s [Pa]
// everywhere.
std::array<double, rows> free_sides(const Scene& scene, const std::array<double, rows>& fractions,
                                    double theta, double p_s) {
  const Tank s(scene);
  State state = s.uniform_state(0.0);
  s.each_cell(
      [&](int, int j, int, std::ptrdiff_t c) { state.f_s[c] = fractions[static_cast<std::size_t>(j)]; });
  s.boundary.fill_scalar(state.f_s);
  state.theta.fill(theta);
  state.p_s.fill(p_s);
  Rheology rheology(s.grid);
  rheology.update(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, state, StrainRate(s.grid));
  std::array<double, rows> side{};
  for (int j = 0; j < rows; ++j)
    side[static_cast<std::size_t>(j)] = rheology.free_side[s.grid.cells.index(2, j, 0)];
  return side;
}

using Sides = std::array<double, rows>;

TEST(FreeSide, IsAboveHeavyGrainsAndBelowLightOnes) {
  const Sides heavy{packed, 0.574, 0.2, 0, 0, 0, 0, 0}, light{0, 0, 0, 0, 0, 0.2, 0.574, packed};
  EXPECT_EQ(free_sides(submerged(2500.0), heavy, 0.0, 100.0), (Sides{0, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(free_sides(submerged(400.0), light, 0.0, 100.0), (Sides{0, 0, 0, 0, 0, -1, 0, 0}));
}

TEST(FreeSide, NoneOfAFullBedNorOfWholeCells) {
  EXPECT_EQ(free_sides(submerged(2500.0), {packed, packed, packed, 0, 0, 0, 0, 0}, 0.0, 100.0), Sides{});
  Scene whole = submerged(2500.0);
  whole.numerics.bed_surface = BedSurface::whole_cells;
  EXPECT_EQ(free_sides(whole, {packed, 0.574, 0.2, 0, 0, 0, 0, 0}, 0.0, 100.0), Sides{});
}

TEST(FreeSide, NoneOfGrainsThatFall) {
  EXPECT_EQ(free_sides(submerged(2500.0), {0, 0, 0, packed, packed, 0.3, 0, 0}, 0.0, 0.0), Sides{});
  EXPECT_EQ(free_sides(submerged(2500.0), {0, 0, 0, 0, 0.2, 0, 0, 0}, 0.0, 0.0), Sides{});
}

// Grains that agitation holds apart do not rest: the dense-flow pressure (15) bears more than their weight.
TEST(FreeSide, NoneOfAgitatedGrains) {
  const Sides bed{packed, 0.574, 0.569, 0, 0, 0, 0, 0};
  EXPECT_EQ(free_sides(submerged(2500.0), bed, 0.0, 100.0)[2], 1.0);
  EXPECT_EQ(free_sides(submerged(2500.0), bed, 1.0, 100.0)[2], 0.0);
}

// Half of the tank liquid, half gas: the fluid that damps a collision is the cell's own.
TEST(Rheology, RestitutionIsThatOfTheCellsFluid) {
  const Tank s(submerged(2500.0));
  const double theta = 1e-4;
  State state = s.uniform_state(0.3);
  state.theta.fill(theta);
  s.each_cell([&](int, int j, int, std::ptrdiff_t c) { state.alpha[c] = j < rows / 2 ? 1.0 : 0.0; });
  Rheology rheology(s.grid);
  rheology.update(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, state, StrainRate(s.grid));
  const auto expected = [&](const Fluid& fluid) {
    return closures::effective_restitution(s.scene.solid.restitution, theta, 2500.0, s.scene.solid.diameter,
                                           fluid.viscosity);
  };
  EXPECT_DOUBLE_EQ(rheology.restitution[s.grid.cells.index(1, 1, 0)], expected(s.scene.liquid));
  EXPECT_DOUBLE_EQ(rheology.restitution[s.grid.cells.index(1, rows - 1, 0)], expected(s.scene.gas));
  EXPECT_LT(expected(s.scene.liquid), expected(s.scene.gas));
}

// What friction reads beyond a wall is what is inside.
TEST(Rheology, PressureBeyondAWallIsThatInside) {
  const Tank s(box_scene(2, {4, rows, 1}, {0.04, 0.08, 1.0}));
  Rheology rheology(s.grid);
  rheology.update(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, s.uniform_state(0.6),
                  StrainRate(s.grid));
  const double inside = rheology.enduring_pressure[s.grid.cells.index(0, 0, 0)];
  EXPECT_GT(inside, 0.0);
  EXPECT_EQ(rheology.enduring_pressure[s.grid.cells.index(-1, 0, 0)], inside);
  EXPECT_EQ(rheology.enduring_pressure[s.grid.cells.index(0, -1, 0)], inside);
}

}  // namespace
}  // namespace granvof
