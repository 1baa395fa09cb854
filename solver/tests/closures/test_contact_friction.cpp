// Coulomb friction, eq (17).
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/contact_friction.hpp"
#include "solver/closures/friction/laws.hpp"

namespace granvof::closures {
namespace {

constexpr double pressure = 100.0;  // [Pa]
constexpr double eta = 0.4;
constexpr double n = 1e5;  // [s]

// Shear stress [Pa] of a simple shear of rate G = du/dy: S_xy = G/2, ||S|| = sqrt(S:S/2) = G/2, tau_xy = 2 mu
// S_xy.
double shear_stress(double rate) {
  return friction_viscosity(pressure, eta, n, 0.5 * rate) * rate;
}

TEST(ContactFriction, Value) {
  // 100 * 0.4 * (1 - exp(-2)) / (2 * 2e-5)
  EXPECT_NEAR(friction_viscosity(pressure, eta, n, 2e-5), 864664.7167633872, 1e-6);
}

TEST(ContactFriction, FastShearIsCoulombsLaw) {
  for (const double rate : {0.01, 1.0, 1e3}) EXPECT_NEAR(shear_stress(rate), eta * pressure, 1e-10) << rate;
}

TEST(ContactFriction, SlowShearIsAViscousFluid) {
  const double plateau = 0.5 * pressure * eta * n;
  EXPECT_NEAR(friction_viscosity(pressure, eta, n, 0.0), plateau, 1e-6);
  // Wherever the code changes from one form to the other: (1 - exp(-x)) / x = 1 - x/2 + x^2/6 - x^3/24 + ...
  for (double x = 1e-12; x < 1e-2; x *= 1.5) {
    const double series = 1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0;
    EXPECT_NEAR(friction_viscosity(pressure, eta, n, x / n) / plateau, series, 1e-9) << x;
  }
}

TEST(ContactFriction, StressGrowsWithRateAndNeverExceedsYield) {
  double previous = 0.0;
  for (double rate = 1e-12; rate < 1e3; rate *= 2.0) {
    EXPECT_GE(shear_stress(rate), previous) << rate;
    EXPECT_LE(shear_stress(rate), eta * pressure * (1.0 + 1e-14)) << rate;
    previous = shear_stress(rate);
  }
}

TEST(ContactFriction, VanishesWithoutPressureOrFriction) {
  EXPECT_EQ(friction_viscosity(0.0, eta, n, 1.0), 0.0);
  EXPECT_EQ(friction_viscosity(pressure, 0.0, n, 1.0), 0.0);
}

// Of a gas that is sheared at `rate` = 2 ||S||.
TEST(ContactFriction, OfTheWholeStressBoundsCollisions) {
  const double hot = 2.0, rate = 10.0;  // [Pa s], [1/s]
  const auto bounded = [=](double kinetic, double borne, double at) {
    return bounded_kinetic_viscosity(kinetic, borne, eta, n, 0.5 * at);
  };
  EXPECT_EQ(bounded(hot, 100.0, rate), hot);                        // 20 Pa of the 40 that it may have
  EXPECT_NEAR(bounded(hot, 25.0, rate) * rate, eta * 25.0, 1e-10);  // 10 Pa, not 20
  EXPECT_NEAR(bounded(hot, 25.0, rate) + friction_viscosity(75.0, eta, n, 0.5 * rate),
              friction_viscosity(100.0, eta, n, 0.5 * rate), 1e-10);  // all that bears, by one law
  EXPECT_EQ(bounded(hot, 25.0, 0.0), hot);
  EXPECT_EQ(bounded(0.0, 25.0, rate), 0.0);
  EXPECT_EQ(bounded(hot, 0.0, rate), 0.0);
}

// Glass beads of Jop et al. 2006.
double mu(double p, double norm) {
  const Solid beads{.density = 2500.0, .diameter = 5e-4, .friction = 0.38};
  return FrictionInertial::coefficient({p, norm}, beads, {.fast_friction = 0.643, .inertial_number = 0.279});
}

TEST(InertialFriction, Value) {
  // gamma = 100 1/s, P = 250 Pa: I = 100 * 5e-4 / sqrt(0.1) = 0.158114
  EXPECT_NEAR(mu(250.0, 50.0), 0.38 + 0.263 / (1.0 + 0.279 / 0.15811388300841897), 1e-12);
}

TEST(InertialFriction, Limits) {
  EXPECT_EQ(mu(100.0, 0.0), 0.38);
  EXPECT_EQ(mu(0.0, 0.0), 0.38);
  EXPECT_NEAR(mu(0.0, 1.0), 0.643, 1e-15);
  EXPECT_NEAR(mu(1.0, 1e9), 0.643, 1e-6);
}

TEST(InertialFriction, GrowsWithRateAndFallsWithPressure) {
  for (double norm = 1e-3; norm < 1e3; norm *= 2.0) {
    EXPECT_LT(mu(100.0, norm), mu(100.0, 2.0 * norm)) << norm;
    EXPECT_GT(mu(100.0, norm), mu(200.0, norm)) << norm;
  }
}

// The layer that stops on a slope is h_stop = L d (tan theta_2 - tan theta) / (tan theta - tan theta_1),
// Pouliquen 1999.
TEST(ArrestFriction, IsTheSlopeOnWhichALayerStops) {
  const double mu_s = 0.38, mu_2 = 0.643, length = 1.65, d = 5e-4;
  for (const double slope : {0.39, 0.45, 0.5, 0.6}) {
    const double h_stop = length * d * (mu_2 - slope) / (slope - mu_s);
    EXPECT_NEAR(arrest_friction(h_stop, mu_s, mu_2, length, d), slope, 1e-12) << slope;
  }
  EXPECT_EQ(arrest_friction(0.0, mu_s, mu_2, length, d), mu_2);
  EXPECT_NEAR(arrest_friction(1e9, mu_s, mu_2, length, d), mu_s, 1e-9);
}

}  // namespace
}  // namespace granvof::closures
