// Viscous contacts: pressure, viscosity of the suspension, mu(I_v), packing by the rate of shear.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/closures/suspension.hpp"
#include "solver/tests/closures/derivative.hpp"

namespace granvof::closures {
namespace {

// The pressure is that at which f_s = f_s,max / (1 + sqrt(I_v)).
TEST(ViscousContactPressure, InvertsThePackingOfASuspension) {
  for (const double i_v : {1e-3, 0.01, 0.1}) {
    const double f = 0.63 / (1.0 + std::sqrt(i_v)), stress = 0.2;
    EXPECT_NEAR(viscous_contact_pressure(f, 0.63, stress).value, stress / i_v, 1e-9 * stress / i_v);
  }
}

TEST(ViscousContactPressure, LimitsAndSlope) {
  EXPECT_EQ(viscous_contact_pressure(0.5, 0.63, 0.0).value, 0.0);
  EXPECT_EQ(viscous_contact_pressure(0.0, 0.63, 1.0).value, 0.0);
  double previous = 0.0;
  for (const double f : {0.1, 0.4, 0.6, 0.616, 0.625, 0.65}) {
    const auto pressure = [](double x) { return viscous_contact_pressure(x, 0.63, 0.2).value; };
    const double expected = test::derivative(pressure, f, 1e-5);
    EXPECT_NEAR(viscous_contact_pressure(f, 0.63, 0.2).slope, expected, 1e-6 * expected) << f;
    EXPECT_GT(pressure(f), previous);
    previous = pressure(f);
  }
}

TEST(SuspensionViscosity, ValueAndLimits) {
  EXPECT_EQ(suspension_viscosity(0.0, 0.63), 1.0);
  // with the fluid's share of the stress, Einstein's 5/2
  EXPECT_NEAR(((1.0 - 1e-4) * suspension_viscosity(1e-4, 0.63) - 1.0) / 1e-4, 2.5, 1e-3);
  EXPECT_NEAR(0.45 * suspension_viscosity(0.55, 0.625), 1.0 + 2.5 * 0.55 / 0.12, 1e-12);
  EXPECT_NEAR(0.37 * suspension_viscosity(0.63, 0.63), 1.0 + 2.5 * 0.63 / 0.02, 1e-9);
}

// Boyer et al. 2011's suspension in a liquid of 0.1 Pa s.
double mu(double p, double norm) {
  return FrictionViscous::coefficient({p, norm, 0.1}, {.friction = 0.32},
                                      {.fast_friction = 0.7, .viscous_number = 0.005});
}

TEST(ViscousFriction, GrowsFromRestToItsLimit) {
  EXPECT_EQ(mu(10.0, 0.0), 0.32);
  EXPECT_EQ(mu(0.0, 1.0), 0.7);
  // I_v = 0.1 x 0.5 / 10 = 0.005: half way
  EXPECT_NEAR(mu(10.0, 0.25), 0.51, 1e-12);
}

TEST(CriticalPacking, FallsWithInertiaAndViscosityAlike) {
  const Contact beads;
  EXPECT_EQ(CriticalPackingByRate::packing(0.0, beads), beads.critical_solid_fraction);
  EXPECT_LT(CriticalPackingByRate::packing(0.1, beads), CriticalPackingByRate::packing(0.01, beads));
  // without viscosity I^2 / 2 with I = 0.1, without inertia I_v
  EXPECT_NEAR(mixed_inertial_number(10.0, 25.0, 2500.0, 1e-3, 0.0), 0.005, 1e-15);
  EXPECT_NEAR(mixed_inertial_number(10.0, 25.0, 2500.0, 0.0, 0.01), 0.004, 1e-15);
  EXPECT_NEAR(CriticalPackingByRate::packing(0.01, beads), beads.critical_solid_fraction / 1.1, 1e-15);
}

TEST(CriticalPacking, DrivesNoFasterThanTheLargestDilatancy) {
  const Contact beads;
  EXPECT_EQ(bounded_critical_packing(0.57, 0.6, beads), 0.57);
  for (const double critical : {0.1, 1.0}) {
    const double bounded = bounded_critical_packing(critical, 0.6, beads);
    EXPECT_NEAR(std::fabs(beads.dilatancy_slope * (0.6 - bounded)), 0.5, 1e-12);
    EXPECT_EQ(bounded < 0.6, critical < 0.6);
  }
}

TEST(CriticalPacking, IsWhatShearDrivesTo) {
  const Contact beads;
  EXPECT_NEAR(sheared_packing(0.6, 100.0, 0.55, beads), 0.55, 1e-12);
}

}  // namespace
}  // namespace granvof::closures
