// Drag, eqs (8) and (9).
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/closures/drag/drag.hpp"

namespace granvof::closures {
namespace {

const Fluid water{.density = 1000.0, .viscosity = 1e-3};
const Fluid air{.density = 1.0, .viscosity = 1e-5};
constexpr double bead = 0.8e-3;  // [m]

// Force of the fluid on one grain [N] of a dilute suspension: beta slip over the number of grains in a
// volume.
double force_on_grain(double f_s, double slip, const Fluid& fluid, double d_s) {
  const double grain_volume = std::numbers::pi / 6.0 * d_s * d_s * d_s;
  return drag_paper(f_s, slip, fluid, d_s) * slip * grain_volume / f_s;
}

TEST(Drag, ValuesOfBothBranches) {
  // (8) and (9) as printed, with C_D: Re = 40, C_D = 1.819 on the upper branch.
  EXPECT_NEAR(drag_paper(0.57, 0.01, water, bead), 189558.1395348836, 1e-6);
  EXPECT_NEAR(drag_paper(0.10, 0.05, water, bead), 10146.414520367789, 1e-8);
}

TEST(Drag, PackedBedHasErgunsPressureDrop) {
  // Ergun's equation gives the pressure drop from the superficial velocity U = f_c u. In a bed at rest the
  // fluid balances f_c dP/dx = beta u.
  const double f_s = 0.6;
  const double f_c = 1.0 - f_s;
  for (const double u : {1e-4, 1e-2, 1.0}) {
    const double superficial = f_c * u;
    const double drop = 150.0 * water.viscosity * f_s * f_s / (f_c * f_c * f_c * bead * bead) * superficial +
                        1.75 * water.density * f_s / (f_c * f_c * f_c * bead) * superficial * superficial;
    EXPECT_NEAR(drag_paper(f_s, u, water, bead) * u, f_c * drop, 1e-12 * drop);
  }
}

TEST(Drag, OneGrainInStokesFlow) {
  const double slip = 1e-9;
  const double stokes = 3.0 * std::numbers::pi * water.viscosity * bead * slip;
  EXPECT_NEAR(force_on_grain(1e-9, slip, water, bead), stokes, 1e-4 * stokes);
}

TEST(Drag, OneGrainAtHighReynoldsNumberHasConstantDragCoefficient) {
  const double slip = 1e6;
  const double newton = 0.4 * 0.5 * water.density * slip * slip * std::numbers::pi / 4.0 * bead * bead;
  EXPECT_NEAR(force_on_grain(1e-9, slip, water, bead), newton, 1e-3 * newton);
}

TEST(Drag, SettlingVelocityOfGlassBeadInWater) {
  // 0.11258 m/s: the root of 4/3 (rho_s/rho_l - 1) g d = C_D u^2 with (9), where Re = 90 and C_D = 1.2385.
  const double weight = (2500.0 - water.density) * 9.81 * std::numbers::pi / 6.0 * bead * bead * bead;
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (force_on_grain(1e-9, middle, water, bead) < weight ? low : high) = middle;
  }
  EXPECT_NEAR(low, 0.11258, 1e-5);
}

TEST(Drag, IsFiniteWithoutSlip) {
  EXPECT_DOUBLE_EQ(drag_times_reynolds(0.0), 24.0);
  for (const double f_s : {0.0, 0.1, 0.2, 0.5, 0.63}) {
    const double beta = drag_paper(f_s, 0.0, water, bead);
    EXPECT_TRUE(std::isfinite(beta)) << f_s;
    EXPECT_NEAR(drag_paper(f_s, 1e-12, water, bead), beta, 1e-6 * beta) << f_s;
  }
}

TEST(Drag, VanishesWithTheGrains) {
  EXPECT_EQ(drag_paper(0.0, 0.5, water, bead), 0.0);
  const double ratio = drag_paper(2e-9, 0.5, water, bead) / drag_paper(1e-9, 0.5, water, bead);
  EXPECT_NEAR(ratio, 2.0, 1e-6);  // linear in f_s: the acceleration of a grain stays finite
}

TEST(Drag, InviscidFluidKeepsItsFormDrag) {
  const Fluid inviscid{.density = 1000.0, .viscosity = 0.0};
  for (const double f_s : {0.05, 0.2, 0.5}) {
    EXPECT_EQ(drag_paper(f_s, 0.0, inviscid, bead), 0.0);
    const double nearly = drag_paper(f_s, 1.0, Fluid{.density = 1000.0, .viscosity = 1e-14}, bead);
    EXPECT_NEAR(drag_paper(f_s, 1.0, inviscid, bead), nearly, 1e-4 * nearly);
  }
}

TEST(Drag, GrowsWithSlip) {
  for (const double f_s : {0.05, 0.19, 0.2, 0.21, 0.6}) {
    double previous = 0.0;
    for (double slip = 1e-5; slip < 10.0; slip *= 2.0) {
      const double beta = drag_paper(f_s, slip, water, bead);
      EXPECT_GT(beta, previous) << "f_s " << f_s << ", slip " << slip;
      previous = beta;
    }
  }
}

TEST(Drag, BranchesAreBlendedWithoutJump) {
  const double narrow = 1e-9;
  for (const double edge : {1.0 - drag_blend_lower, 1.0 - drag_blend_upper}) {
    const double below = drag_paper(edge - narrow, 0.02, water, bead);
    const double above = drag_paper(edge + narrow, 0.02, water, bead);
    EXPECT_NEAR(below, above, 1e-6 * above);
  }
  const double ergun = drag_ergun(0.2, 0.02, water, bead);
  const double wen_yu = drag_wen_yu(0.2, 0.02, water, bead);
  EXPECT_NEAR(drag_paper(0.2, 0.02, water, bead), 0.5 * (ergun + wen_yu), 1e-9 * ergun);
}

TEST(Drag, PrintedBranchesDoNotMeet) {
  // At f_c = 0.8 and Re -> 0: 150 f_s^2 / f_c = 7.5 against 18 f_s f_c^-1.65 = 5.202, both times mu / d^2.
  EXPECT_NEAR(drag_ergun(0.2, 0.0, water, bead) / drag_wen_yu(0.2, 0.0, water, bead), 7.5 / 5.2023, 1e-4);
}

TEST(Drag, MixtureIsWeightedByTheLiquidShare) {
  const double slip = 0.3;
  const double liquid = drag_paper(0.5, slip, water, bead);
  const double gas = drag_paper(0.5, slip, air, bead);
  EXPECT_EQ(drag_coefficient(drag_paper, 0.5, 1.0, slip, air, water, bead), liquid);
  EXPECT_EQ(drag_coefficient(drag_paper, 0.5, 0.0, slip, air, water, bead), gas);
  EXPECT_NEAR(drag_coefficient(drag_paper, 0.5, 0.25, slip, air, water, bead), 0.25 * liquid + 0.75 * gas,
              1e-12 * liquid);
}

}  // namespace
}  // namespace granvof::closures
