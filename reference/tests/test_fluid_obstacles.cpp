// Obstacles in the way of gas and liquid.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "reference/tests/fluid_tank.hpp"

namespace {

using demvof::BeadLoad;
using demvof::Fluid;
using demvof::FluidSettings;
using demvof::FluidSide;
using demvof::test::expect_that_a_gate_blocks;
using demvof::test::filled_to;
using demvof::test::fluid_tank;
using demvof::test::no_beads;

// Closes cells [lower, upper) of a tank.
void put_obstacle(FluidSettings& s, std::array<int, 2> lower, std::array<int, 2> upper) {
  s.obstacles.resize(static_cast<std::size_t>(s.cells[0]) * static_cast<std::size_t>(s.cells[1]), 0);
  for (int j = lower[1]; j < upper[1]; ++j)
    for (int i = lower[0]; i < upper[0]; ++i)
      s.obstacles[static_cast<std::size_t>(j) * static_cast<std::size_t>(s.cells[0]) +
                  static_cast<std::size_t>(i)] = 1;
}

std::size_t cells_of(const FluidSettings& s) {
  return static_cast<std::size_t>(s.cells[0]) * static_cast<std::size_t>(s.cells[1]);
}

// A step on the floor, a wall that hangs into the water from above, and a shelf under water on the right
// wall.
FluidSettings furnished_tank() {
  FluidSettings s = fluid_tank(16, 16);
  put_obstacle(s, {{3, 0}}, {{7, 4}});
  put_obstacle(s, {{9, 2}}, {{11, 16}});
  put_obstacle(s, {{13, 5}}, {{16, 7}});
  return s;
}

constexpr double cell = 2.5e-3;

}  // namespace

TEST(FluidObstacles, APoolAmongThemIsHydrostaticFromTheStartAndStaysSo) {
  const FluidSettings s = furnished_tank();
  Fluid fluid(s, filled_to(s, 0.025, 16), std::vector<double>(256, 1.0));
  const auto expect_hydrostatic = [&] {
    for (std::size_t c = 0; c < 256; ++c) {
      const double y = (static_cast<double>(c / 16) + 0.5) * cell;
      const double expected = 9.81 * (1.0 * std::min(0.015, 0.04 - y) + 1000.0 * std::max(0.0, 0.025 - y));
      EXPECT_NEAR(fluid.view().pressure[c], s.obstacles[c] != 0 ? 0.0 : expected, 0.5) << c;
      if (s.obstacles[c] != 0) {
        EXPECT_EQ(fluid.view().alpha[c], 0.0) << c;
      }
    }
  };
  expect_hydrostatic();
  for (int n = 0; n < 50; ++n) fluid.step(2e-4, no_beads(256));
  EXPECT_LT(fluid.largest_speed(), 1e-4);
  expect_hydrostatic();
  // Walls and obstacles carry the weight of what is in the tank: 10 rows of water less 26 closed cells.
  const double water = 160.0 - 16.0 - 16.0 - 6.0, gas = 96.0 - 12.0;
  const double weight = 9.81 * cell * cell * 4e-3 * (1000.0 * water + gas);
  EXPECT_NEAR(fluid.boundary_force()[1], weight, 0.01 * weight);
  EXPECT_NEAR(fluid.liquid_volume(), water * cell * cell * 4e-3, 1e-12);
}

TEST(FluidObstacles, AnInclinedTankWithThemStandsInHydrostaticPressure) {
  FluidSettings s = fluid_tank(16, 16);
  put_obstacle(s, {{3, 0}}, {{7, 4}});
  put_obstacle(s, {{9, 8}}, {{12, 11}});
  s.sides[3] = FluidSide::no_slip;
  s.inclination = 30.0;
  Fluid fluid(s, std::vector<double>(256, 1.0), std::vector<double>(256, 1.0));
  for (int n = 0; n < 20; ++n) fluid.step(2e-4, no_beads(256));
  EXPECT_LT(fluid.largest_speed(), 1e-6);
  const std::vector<double>& p = fluid.view().pressure;
  EXPECT_NEAR(p[15] - p[0], 1000.0 * 9.81 * 0.5 * 15 * cell, 0.1);
  EXPECT_NEAR(p[0] - p[15 * 16], 1000.0 * 9.81 * std::sqrt(0.75) * 15 * cell, 0.1);
}

// A dam breaks in a tank that obstacles make smaller, on the right and on the floor, as in one of that size.
TEST(FluidObstacles, ATankMadeSmallerByThemIsOneOfThatSize) {
  const FluidSettings small = fluid_tank(24, 16);
  FluidSettings large = fluid_tank(32, 20);
  put_obstacle(large, {{24, 0}}, {{32, 20}});
  put_obstacle(large, {{0, 0}}, {{32, 4}});
  const std::size_t cells = cells_of(large);
  Fluid expected(small, filled_to(small, 0.03, 10), std::vector<double>(cells_of(small), 1.0));
  Fluid found(large, filled_to(large, 0.04, 10), std::vector<double>(cells, 1.0));
  for (int n = 0; n < 300; ++n) {
    expected.step(2e-4, no_beads(cells_of(small)));
    found.step(2e-4, no_beads(cells));
  }
  EXPECT_GT(expected.largest_speed(), 0.3);
  for (std::size_t j = 0; j < 16; ++j) {
    for (std::size_t i = 0; i < 24; ++i) {
      const std::size_t in_small = j * 24 + i, in_large = (j + 4) * 32 + i;
      EXPECT_NEAR(found.view().alpha[in_large], expected.view().alpha[in_small], 1e-6);
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR(found.view().velocity[d][in_large], expected.view().velocity[d][in_small], 1e-5);
      EXPECT_NEAR(found.view().pressure[in_large], expected.view().pressure[in_small], 0.1);
    }
  }
  EXPECT_NEAR(found.kinetic_energy(), expected.kinetic_energy(), 1e-6 * expected.kinetic_energy());
  for (std::size_t d = 0; d < 2; ++d)
    EXPECT_NEAR(found.boundary_force()[d], expected.boundary_force()[d], 1e-5);
}

TEST(FluidObstacles, ADamBreakOverAStepKeepsItsLiquidAndItsEnergy) {
  FluidSettings s = fluid_tank(32, 16);
  s.sides[3] = FluidSide::no_slip;
  put_obstacle(s, {{16, 0}}, {{20, 4}});
  Fluid fluid(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
  const double start = fluid.liquid_volume(), before = fluid.potential_energy();
  for (int n = 0; n < 600; ++n) fluid.step(2e-4, no_beads(512));
  EXPECT_NEAR(fluid.liquid_volume() / start, 1.0, 1e-8);
  double beyond = 0.0;
  for (std::size_t c = 0; c < 512; ++c) {
    EXPECT_GT(fluid.view().alpha[c], -1e-6);
    EXPECT_LT(fluid.view().alpha[c], 1.0 + 1e-6);
    if (s.obstacles[c] != 0) {
      EXPECT_EQ(fluid.view().alpha[c], 0.0);
    }
    if (c % 32 >= 20) beyond += fluid.view().alpha[c];
  }
  EXPECT_GT(beyond, 1.0);  // it does get over
  const demvof::FluidWork& w = fluid.work();
  const double given = w.gravity, kept = fluid.kinetic_energy();
  EXPECT_GT(given, 0.2 * (before - fluid.potential_energy()));
  EXPECT_NEAR(kept + w.viscosity + w.outflow + w.numerical_time + w.numerical_momentum, given + w.pressure,
              0.01 * given);
}

// A slit between two blocks, with a gate at the side of one.
TEST(FluidObstacles, AGateBesideThemBlocksTheFluid) {
  FluidSettings s = fluid_tank(32, 16);
  put_obstacle(s, {{12, 0}}, {{16, 3}});
  put_obstacle(s, {{12, 5}}, {{16, 14}});
  expect_that_a_gate_blocks(s);
}

// In three dimensions: a block in the middle, still water about and above it.
TEST(FluidObstacles, ABlockInThreeDimensionsLeavesThePoolAtRest) {
  FluidSettings s = fluid_tank(6, 8);
  s.cells[2] = 5;
  s.spacing[2] = cell;
  s.sides[4] = s.sides[5] = FluidSide::no_slip;
  const std::size_t cells = 6 * 8 * 5;
  s.obstacles.assign(cells, 0);
  std::vector<double> alpha;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 6; ++i) {
        if (k > 0 && k < 3 && j > 1 && j < 4 && i > 1 && i < 5) s.obstacles[(k * 8 + j) * 6 + i] = 1;
        alpha.push_back(j < 6 ? 1.0 : 0.0);
      }
  Fluid fluid(s, alpha, std::vector<double>(cells, 1.0));
  for (int n = 0; n < 20; ++n) fluid.step(2e-4, no_beads(cells));
  EXPECT_LT(fluid.largest_speed(), 1e-4);
  const double weight = 9.81 * std::pow(cell, 3) * (1000.0 * (180.0 - 12.0) + 60.0);
  EXPECT_NEAR(fluid.boundary_force()[1], weight, 0.01 * weight);
}
