#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "reference/demvof/fluid/fluid.hpp"

namespace {

using demvof::BeadLoad;
using demvof::Fluid;
using demvof::FluidSettings;
using demvof::FluidSide;

FluidSettings tank(int nx, int ny) {
  FluidSettings s;
  s.cells = {{nx, ny, 1}};
  s.spacing = {{2.5e-3, 2.5e-3, 4e-3}};
  s.sides = {{FluidSide::no_slip, FluidSide::no_slip, FluidSide::no_slip, FluidSide::open, FluidSide::empty,
              FluidSide::empty}};
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  return s;
}

BeadLoad no_beads(std::size_t cells) {
  BeadLoad load;
  load.void_fraction.assign(cells, 1.0);
  load.drag_coefficient.assign(cells, 0.0);
  for (auto& component : load.force) component.assign(cells, 0.0);
  return load;
}

std::vector<double> filled_to(const FluidSettings& s, double level, int columns) {
  std::vector<double> alpha;
  for (int j = 0; j < s.cells[1]; ++j)
    for (int i = 0; i < s.cells[0]; ++i)
      alpha.push_back(i < columns && j * s.spacing[1] < level - 1e-9 ? 1.0 : 0.0);
  return alpha;
}

}  // namespace

TEST(Fluid, APoolStaysAtRestUnderHydrostaticPressure) {
  const FluidSettings s = tank(16, 16);
  Fluid fluid(s, filled_to(s, 0.025, 16), std::vector<double>(256, 1.0));
  const BeadLoad load = no_beads(256);
  for (int n = 0; n < 20; ++n) fluid.step(2e-4, load);
  EXPECT_LT(fluid.largest_speed(), 1e-4);
  const double gas = 1.0 * 9.81 * 0.015, water = 1000.0 * 9.81 * (0.025 - 0.5 * 2.5e-3);
  EXPECT_NEAR(fluid.view().pressure[0], gas + water, 0.5);
  EXPECT_NEAR(fluid.view().pressure_gradient[1][0], -9810.0, 5.0);
  // The walls carry the weight of what is in the tank.
  const double weight = 9.81 * 0.04 * 4e-3 * (0.025 * 1000.0 + 0.015 * 1.0);
  EXPECT_NEAR(fluid.boundary_force()[1], weight, 0.01 * weight);
}

// Full of water and closed, the floor inclined by 30 degrees: at rest, and along the floor as well.
TEST(Fluid, AnInclinedTankStandsInHydrostaticPressure) {
  FluidSettings s = tank(16, 16);
  s.sides[3] = FluidSide::slip;
  s.inclination = 30.0;
  Fluid fluid(s, std::vector<double>(256, 1.0), std::vector<double>(256, 1.0));
  const BeadLoad load = no_beads(256);
  for (int n = 0; n < 20; ++n) fluid.step(2e-4, load);
  EXPECT_LT(fluid.largest_speed(), 1e-6);
  const std::vector<double>& p = fluid.view().pressure;
  EXPECT_NEAR(p[15] - p[0], 1000.0 * 9.81 * 0.5 * 15 * 2.5e-3, 0.1);
  EXPECT_NEAR(p[0] - p[15 * 16], 1000.0 * 9.81 * std::sqrt(0.75) * 15 * 2.5e-3, 0.1);
}

TEST(Fluid, BeforeTheFirstStepThePressureIsHydrostatic) {
  const FluidSettings s = tank(16, 16);
  const Fluid fluid(s, filled_to(s, 0.025, 16), std::vector<double>(256, 1.0));
  const double gas = 1.0 * 9.81 * 0.015, water = 1000.0 * 9.81 * (0.025 - 0.5 * 2.5e-3);
  EXPECT_NEAR(fluid.view().pressure[0], gas + water, 0.5);
  EXPECT_NEAR(fluid.view().pressure[15 * 16], 1.0 * 9.81 * 0.5 * 2.5e-3, 0.5);
}

TEST(Fluid, ADamBreakKeepsItsLiquidAndStaysBounded) {
  const FluidSettings s = tank(32, 16);
  Fluid fluid(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
  const BeadLoad load = no_beads(512);
  const double start = fluid.liquid_volume();
  for (int n = 0; n < 300; ++n) fluid.step(2e-4, load);
  EXPECT_NEAR(fluid.liquid_volume() / start, 1.0, 1e-8);
  double least = 1.0, most = 0.0;
  for (const double a : fluid.view().alpha) {
    least = std::min(least, a);
    most = std::max(most, a);
  }
  EXPECT_GT(least, -1e-6);
  EXPECT_LT(most, 1.0 + 1e-6);
  EXPECT_GT(fluid.largest_speed(), 0.3);  // it does break
}

// Water on the left of a closed gate stays there; with the gate half open it leaves.
TEST(Fluid, AGateBlocksTheFluid) {
  const FluidSettings s = tank(32, 16);
  const BeadLoad load = no_beads(512);
  const auto right_half = [](const Fluid& fluid) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 512; ++c) sum += c % 32 >= 10 ? fluid.view().alpha[c] : 0.0;
    return sum;
  };
  Fluid closed(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
  closed.set_gate(10, std::vector<double>(16, 0.0));
  for (int n = 0; n < 50; ++n) closed.step(2e-4, load);
  EXPECT_LT(right_half(closed), 1e-9);
  EXPECT_LT(closed.largest_speed(), 1e-3);

  Fluid open(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
  std::vector<double> share(16, 0.0);
  for (std::size_t j = 0; j < 4; ++j) share[j] = 1.0;
  open.set_gate(10, share);
  for (int n = 0; n < 50; ++n) open.step(2e-4, load);
  EXPECT_GT(right_half(open), 1.0);
}

// A uniform force on the fluid of a closed column builds up its own pressure gradient.
TEST(Fluid, AForceOnTheFluidIsBalancedByPressureAtRest) {
  FluidSettings s = tank(8, 16);
  s.gravity = 0.0;
  s.sides[3] = FluidSide::slip;
  Fluid fluid(s, std::vector<double>(128, 1.0), std::vector<double>(128, 0.5));
  BeadLoad load = no_beads(128);
  load.void_fraction.assign(128, 0.5);
  load.force[1].assign(128, 100.0);
  load.drag_coefficient.assign(128, 1e5);
  for (int n = 0; n < 50; ++n) fluid.step(2e-4, load);
  EXPECT_LT(fluid.largest_speed(), 1e-6);
  // eps dp/dy = F
  EXPECT_NEAR(fluid.view().pressure_gradient[1][4 + 8 * 4], 100.0 / 0.5, 2.0);
}

TEST(Fluid, AMissingScratchFolderIsNamed) {
  FluidSettings s = tank(4, 4);
  s.scratch_folder = "/proc/nowhere";
  EXPECT_THROW(
      {
        try {
          Fluid fluid(s, std::vector<double>(16, 1.0), std::vector<double>(16, 1.0));
        } catch (const std::runtime_error& error) {
          EXPECT_NE(std::string(error.what()).find("/proc/nowhere"), std::string::npos);
          throw;
        }
      },
      std::runtime_error);
}
