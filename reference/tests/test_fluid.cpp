#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/tests/fluid_tank.hpp"

namespace {

using demvof::BeadLoad;
using demvof::Fluid;
using demvof::FluidSettings;
using demvof::FluidSide;
using demvof::MomentumConvection;
using demvof::test::expect_that_a_gate_blocks;
using demvof::test::filled_to;
using demvof::test::fluid_tank;
using demvof::test::no_beads;
using demvof::test::right_of_gate;

}  // namespace

TEST(Fluid, APoolStaysAtRestUnderHydrostaticPressure) {
  const FluidSettings s = fluid_tank(16, 16);
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
  FluidSettings s = fluid_tank(16, 16);
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
  const FluidSettings s = fluid_tank(16, 16);
  const Fluid fluid(s, filled_to(s, 0.025, 16), std::vector<double>(256, 1.0));
  const double gas = 1.0 * 9.81 * 0.015, water = 1000.0 * 9.81 * (0.025 - 0.5 * 2.5e-3);
  EXPECT_NEAR(fluid.view().pressure[0], gas + water, 0.5);
  EXPECT_NEAR(fluid.view().pressure[15 * 16], 1.0 * 9.81 * 0.5 * 2.5e-3, 0.5);
}

TEST(Fluid, ADamBreakKeepsItsLiquidAndStaysBounded) {
  const FluidSettings s = fluid_tank(32, 16);
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
  const FluidSettings s = fluid_tank(32, 16);
  expect_that_a_gate_blocks(s);

  const BeadLoad load = no_beads(512);
  Fluid open(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
  std::vector<double> share(16, 0.0);
  for (std::size_t j = 0; j < 4; ++j) share[j] = 1.0;
  open.set_gate(10, share);
  for (int n = 0; n < 50; ++n) open.step(2e-4, load);
  EXPECT_GT(right_of_gate(s, open), 1.0);
}

// A uniform force on the fluid of a closed column builds up its own pressure gradient.
TEST(Fluid, AForceOnTheFluidIsBalancedByPressureAtRest) {
  FluidSettings s = fluid_tank(8, 16);
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

// A whirl in a closed square of water without viscosity: spun up by a force for 10 ms, then left alone for
// 0.1 s. Only the scheme can take from it.
struct Whirl {
  double kinetic = 0.0;   // at the end [J]
  double lost = 0.0;      // by the convection scheme, once it is left alone [J]
  double residual = 0.0;  // of the energy over that time [J]
};

Whirl whirl(MomentumConvection convection, int n) {
  FluidSettings s = fluid_tank(n, n);
  const double side = 0.04;
  s.spacing = {{side / n, side / n, 4e-3}};
  s.gravity = s.liquid_viscosity = s.gas_viscosity = 0.0;
  s.large_eddy = false;
  for (std::size_t w = 0; w < 4; ++w) s.sides[w] = FluidSide::slip;
  s.convection = convection;
  const auto cells = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  Fluid fluid(s, std::vector<double>(cells, 1.0), std::vector<double>(cells, 1.0));
  BeadLoad load = no_beads(cells);
  const auto spin = [&](double force) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double x = std::numbers::pi * (i + 0.5) / n, y = std::numbers::pi * (j + 0.5) / n;
        const auto c =
            static_cast<std::size_t>(j) * static_cast<std::size_t>(n) + static_cast<std::size_t>(i);
        load.force[0][c] = force * std::sin(x) * std::cos(y);
        load.force[1][c] = -force * std::cos(x) * std::sin(y);
      }
    }
  };
  spin(1e4);
  for (int step = 0; step < 20; ++step) fluid.step(5e-4, load);
  spin(0.0);
  const demvof::FluidWork before = fluid.work();
  const double start = fluid.kinetic_energy();
  for (int step = 0; step < 200; ++step) fluid.step(5e-4, load);
  const demvof::FluidWork after = fluid.work();
  Whirl result;
  result.kinetic = fluid.kinetic_energy();
  result.lost = after.numerical_momentum - before.numerical_momentum;
  result.residual = result.kinetic - start + result.lost + (after.numerical_time - before.numerical_time) -
                    (after.pressure - before.pressure);
  return result;
}

TEST(Convection, UpwindLosesInProportionToTheCells) {
  const Whirl coarse = whirl(MomentumConvection::upwind, 16), fine = whirl(MomentumConvection::upwind, 32);
  EXPECT_NEAR(coarse.lost / coarse.kinetic / (fine.lost / fine.kinetic), 2.0, 0.4);
}

TEST(Convection, VanLeerLosesLittleAndLessThanAThirdOnHalfTheCells) {
  const Whirl coarse = whirl(MomentumConvection::van_leer, 16),
              fine = whirl(MomentumConvection::van_leer, 32);
  const Whirl upwind = whirl(MomentumConvection::upwind, 32);
  EXPECT_GT(fine.lost, 0.0);
  EXPECT_LT(fine.lost, 0.2 * upwind.lost);
  EXPECT_LT(fine.lost, coarse.lost / 3.0);
}

TEST(Convection, TheLedgerKnowsWhatEitherSchemeTakes) {
  for (const MomentumConvection scheme : {MomentumConvection::upwind, MomentumConvection::van_leer}) {
    const Whirl result = whirl(scheme, 16);
    EXPECT_LT(std::abs(result.residual), 0.01 * result.lost);
  }
}

// Where water shoots through gas a scheme of second order must not make new extremes: no faster than upwind
// by more than what that spreads, liquid kept and bounded, and energy taken, never given.
TEST(Convection, VanLeerStaysBoundedInADamBreak) {
  double fastest[2] = {0.0, 0.0};
  for (const MomentumConvection scheme : {MomentumConvection::upwind, MomentumConvection::van_leer}) {
    FluidSettings s = fluid_tank(32, 16);
    s.convection = scheme;
    Fluid fluid(s, filled_to(s, 0.03, 10), std::vector<double>(512, 1.0));
    const BeadLoad load = no_beads(512);
    const double start = fluid.liquid_volume();
    double taken = 0.0;
    for (int n = 0; n < 300; ++n) {
      fluid.step(2e-4, load);
      EXPECT_GE(fluid.work().numerical_momentum, taken - 1e-12) << n;
      taken = fluid.work().numerical_momentum;
      for (std::size_t c = 0; c < 512; ++c) {
        if (fluid.view().alpha[c] < 0.5) continue;
        const double speed = std::hypot(fluid.view().velocity[0][c], fluid.view().velocity[1][c]);
        fastest[scheme == MomentumConvection::van_leer] =
            std::max(fastest[scheme == MomentumConvection::van_leer], speed);
      }
    }
    EXPECT_NEAR(fluid.liquid_volume() / start, 1.0, 1e-8);
    for (const double a : fluid.view().alpha) {
      EXPECT_GT(a, -1e-6);
      EXPECT_LT(a, 1.0 + 1e-6);
    }
  }
  // The free fall of the dam's height: no water can be faster by pressure and gravity alone.
  EXPECT_LT(fastest[1], 2.0 * std::sqrt(9.81 * 0.03));
  EXPECT_GT(fastest[1], fastest[0]);
}

TEST(Fluid, AMissingScratchFolderIsNamed) {
  FluidSettings s = fluid_tank(4, 4);
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
