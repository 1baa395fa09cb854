// Restitution coefficient in a liquid, eq (18).
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/restitution.hpp"

namespace granvof::closures {
namespace {

constexpr double e0 = 0.9;
constexpr double rho_s = 2500.0;  // [kg/m3]
constexpr double d_s = 0.8e-3;    // [m]
constexpr double water = 1e-3;    // [Pa s]

// Theta [m2/s2] at which the Stokes number rho_s d_s sqrt(Theta) / (18 mu) has a wanted value.
double theta_of_stokes(double stokes) {
  const double speed = stokes * 18.0 * water / (rho_s * d_s);
  return speed * speed;
}

TEST(Restitution, ValueAtStokes100) {
  EXPECT_NEAR(effective_restitution(e0, theta_of_stokes(100.0), rho_s, d_s, water), 0.9 - 0.285, 1e-12);
}

TEST(Restitution, ValueFromMaterialData) {
  // sqrt(Theta) = 0.1 m/s: St = 2500 * 0.0008 * 0.1 / 0.018 = 11.11, 2.85 / sqrt(11.11) = 0.855.
  EXPECT_NEAR(effective_restitution(e0, 0.01, rho_s, d_s, water), 0.045, 1e-12);
}

TEST(Restitution, StaysBetweenZeroAndItsDryValue) {
  EXPECT_EQ(effective_restitution(e0, 0.0, rho_s, d_s, water), 0.0);
  EXPECT_EQ(effective_restitution(e0, 1e-300, rho_s, d_s, water), 0.0);
  EXPECT_NEAR(effective_restitution(e0, 1e16, rho_s, d_s, water), e0, 1e-4);
  EXPECT_LE(effective_restitution(e0, 1e300, rho_s, d_s, water), e0);
  EXPECT_EQ(effective_restitution(0.0, 1.0, rho_s, d_s, water), 0.0);
}

TEST(Restitution, IsTheDryValueWithoutLiquidFriction) {
  EXPECT_EQ(effective_restitution(e0, 1.0, rho_s, d_s, 0.0), e0);
  EXPECT_EQ(effective_restitution(e0, 0.0, rho_s, d_s, 0.0), e0);
}

TEST(Restitution, ReboundBeginsAtACriticalStokesNumber) {
  const double critical = (2.85 / e0) * (2.85 / e0);  // 10.03
  EXPECT_EQ(effective_restitution(e0, theta_of_stokes(0.999 * critical), rho_s, d_s, water), 0.0);
  EXPECT_GT(effective_restitution(e0, theta_of_stokes(1.001 * critical), rho_s, d_s, water), 0.0);
}

TEST(Restitution, GrowsWithTheta) {
  double previous = 0.0;
  for (double theta = theta_of_stokes(11.0); theta < 1e4; theta *= 3.0) {
    const double e = effective_restitution(e0, theta, rho_s, d_s, water);
    EXPECT_GT(e, previous);
    previous = e;
  }
}

TEST(Restitution, FrictionTakesFromCollisions) {
  EXPECT_NEAR(frictional_restitution(0.9, 0.4), 0.9 - 0.6 * std::exp(-1.2), 1e-15);  // 0.719
  EXPECT_EQ(frictional_restitution(0.9, 0.0), 0.9);
  EXPECT_EQ(frictional_restitution(0.1, 0.3), 0.0);
  EXPECT_NEAR(frictional_restitution(0.9, 1.0 / 3.0), 0.9 - 0.5 / std::exp(1.0), 1e-15);  // takes most there
}

}  // namespace
}  // namespace granvof::closures
