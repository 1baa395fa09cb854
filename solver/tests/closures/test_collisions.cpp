// Choices of the laws of collisions: correlation, streaming, bumpy walls.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/closures/bumpy_wall.hpp"
#include "solver/closures/collisions.hpp"
#include "solver/closures/solid_pressure.hpp"
#include "solver/tests/closures/derivative.hpp"

namespace granvof::closures {
namespace {

// Worked out by hand: (30 / (1 + pi / 12) x 0.3 x 0.25 x 16)^(1/3) / 2.
TEST(CorrelationLength, ValueAndLimits) {
  EXPECT_NEAR(correlation_length(0.5, 0.7, 16.0), 1.528, 1e-3);
  EXPECT_EQ(correlation_length(0.1, 0.7, 1.3), 1.0);    // dilute
  EXPECT_EQ(correlation_length(0.55, 1.0, 20.0), 1.0);  // elastic
  EXPECT_EQ(correlation_length(0.0, 0.0, 1.0), 1.0);
}

TEST(CorrelationLength, LogSlopeIsTheDerivative) {
  Collisions laws;
  laws.correlated = true;
  for (std::size_t law = 0; law < RadialDistributions::facts.size(); ++law) {
    laws.radial = RadialDistribution(law);
    const auto log_length = [&](double f) { return std::log(laws.correlation(f, 0.3)); };
    for (const double f : {0.1, 0.5, 0.58, 0.61})
      EXPECT_NEAR(laws.correlation_log_slope(f, 0.3), test::derivative(log_length, f, 1e-5), 1e-5) << f;
  }
}

// Against the formulae as printed, term by term.
TEST(Streaming, ViscosityAndConductivityAreThePrintedSums) {
  const double e = 0.7, rho_s = 2500.0, d_s = 1e-3, theta = 4e-4, root = std::sqrt(theta * std::numbers::pi);
  Collisions laws;
  laws.transport = KineticTransport::of<TransportWithStreaming>();
  for (const double f : {0.05, 0.3, 0.55}) {
    const double g0 = laws.g0(f), pi = std::numbers::pi;
    const double mu = rho_s * d_s * root *
                      (0.8 * f * f * g0 * 1.7 / pi + g0 * 1.7 * 1.1 * f * f / (15.0 * 2.3) + f / (6.0 * 2.3));
    const double b = (49.0 - 33.0 * 0.7) / 16.0;
    const double kappa = rho_s * d_s * root *
                         (2.0 * f * f * g0 * 1.7 / pi + 9.0 / 8.0 * g0 * 0.25 * 1.7 * 1.7 * 0.4 * f * f / b +
                          15.0 / 32.0 * f / b);
    EXPECT_NEAR(laws.viscosity(f, theta, e, rho_s, d_s), mu, 1e-12 * mu) << f;
    EXPECT_NEAR(laws.viscosity(f, theta, e, rho_s, d_s) * laws.conductivity_to_viscosity(f, e), kappa,
                1e-12 * kappa)
        << f;
  }
}

// A dilute gas has a viscosity that does not depend on how many grains there are; (20) has none. Never below
// (20), for sticky grains either.
TEST(Streaming, Limits) {
  Collisions laws, paper;
  laws.transport = KineticTransport::of<TransportWithStreaming>();
  const auto per_grain = [](const Collisions& l, double f) { return l.viscosity(f, 1.0, 0.9, 1.0, 1.0) / f; };
  EXPECT_NEAR(per_grain(laws, 1e-6), std::sqrt(std::numbers::pi) / (6.0 * 2.1), 1e-4);
  EXPECT_LT(per_grain(paper, 1e-6), 1e-5);
  for (const double e : {0.0, 0.2, 0.9}) {
    for (const double f : {0.01, 0.6}) {
      EXPECT_GE(laws.viscosity(f, 1.0, e, 1.0, 1.0), paper.viscosity(f, 1.0, e, 1.0, 1.0));
      EXPECT_GT(laws.conductivity_to_viscosity(f, e), 0.0);
    }
  }
}

TEST(Collisions, AreThePapersUnlessAScenesChoicesSayOtherwise) {
  const Collisions paper{Contact{}};
  EXPECT_EQ(paper.g0(0.5), RadialPaper::value(0.5, {0.63}));
  EXPECT_EQ(paper.correlation(0.6, 0.1), 1.0);
  EXPECT_EQ(paper.conductivity_to_viscosity(0.5, 0.7), conductivity_to_viscosity);
  Scene scene;
  scene.solid.friction = 0.5;
  scene.model.radial_distribution = RadialDistribution::of<RadialJamming>();
  const Collisions chosen(scene);
  EXPECT_EQ(chosen.g0(0.5), RadialJamming::value(0.5, {0.63, jamming_amplitude(0.5)}));
  EXPECT_EQ(chosen.g0_slope(0.5), RadialJamming::slope(0.5, {0.63, jamming_amplitude(0.5)}));
}

// Correlated collisions leave the dense-flow law of (15) as it is: Theta of a steady shear is L times larger,
// and P^D that much smaller per Theta.
TEST(CorrelatedCollisions, DensePressureOfASteadyShearIsThatOfTheDenseFlowLaw) {
  const Contact contact;
  SolidLaw chance(2500.0, contact, true), correlated = chance;
  correlated.collisions.correlated = true;
  for (const double f : {0.5, 0.57, 0.59}) {
    GrainsOfCell cell{1e-3, 0.3, 0.0, contact.solid_fraction_min};
    const double length = correlated.collisions.correlation(f, cell.e);
    EXPECT_GT(length, 1.2);
    const double by_chance = dense_pressure(f, cell, chance).value;
    cell.theta *= length;
    EXPECT_NEAR(dense_pressure(f, cell, correlated).value, by_chance, 1e-12 * by_chance) << f;
  }
}

TEST(CorrelatedCollisions, PressureDoesNotFallAndItsSlopeIsTheDerivative) {
  SolidLaw law(2500.0, Contact{}, true);
  law.collisions.correlated = true;
  for (std::size_t place = 0; place < RadialDistributions::facts.size(); ++place) {
    law.collisions.radial = RadialDistribution(place);
    const GrainsOfCell cell{1e-4, 0.3, 0.0, 0.57, 0.05};
    const auto pressure = [&](double f) { return solid_pressure(f, cell, law).value; };
    double previous = 0.0;
    for (double f = 1e-4; f < 0.66; f += 1e-4) {
      ASSERT_GE(pressure(f), previous) << f;
      previous = pressure(f);
    }
    for (const double f : {0.1, 0.5, 0.575, 0.59, 0.61, 0.64}) {
      const double expected = test::derivative(pressure, f, 1e-5);
      EXPECT_NEAR(solid_pressure(f, cell, law).slope, expected, 1e-5 * expected) << f;
    }
  }
}

// Against the integral over the cap, done by sums: s / p = sum(k_x^2) 4 / sqrt(2 pi) / sum(k_y).
TEST(BumpyWall, SlipIsTheIntegralOverTheCap) {
  for (const double degrees : {20.0, 36.0, 90.0}) {
    const double psi = degrees * std::numbers::pi / 180.0;
    double along = 0.0, across = 0.0;
    constexpr int pieces = 2000;
    for (int i = 0; i < pieces; ++i) {
      const double angle = (i + 0.5) / pieces * psi, solid_angle = std::sin(angle);
      along += 0.5 * std::sin(angle) * std::sin(angle) * solid_angle;
      across += std::cos(angle) * solid_angle;
    }
    const double stress = 4.0 / std::sqrt(2.0 * std::numbers::pi) * along / across;
    EXPECT_NEAR(bumpy_wall_slip(psi) * stress, 1.0, 1e-6) << degrees;
  }
}

TEST(BumpyWall, Limits) {
  EXPECT_GT(bumpy_wall_slip(1e-3), 1e6);  // a smooth wall
  EXPECT_NEAR(bumpy_wall_slip(0.5 * std::numbers::pi), 0.94, 1e-4);
  EXPECT_EQ(bumpy_wall_loss(1.0), 0.0);
  EXPECT_NEAR(bumpy_wall_loss(0.7), 0.6938, 1e-4);
}

}  // namespace
}  // namespace granvof::closures
