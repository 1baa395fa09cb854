// Total solid pressure and its slope, eqs (11)-(15).
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "solver/tests/closures/derivative.hpp"
#include "solver/tests/solid_pressure_of_paper.hpp"

namespace granvof::closures {
namespace {

using test::enduring_pressure;
using test::solid_pressure;

const Contact paper;
constexpr double theta = 1e-4;  // [m2/s2]
constexpr double e = 0.3;
constexpr double rho_s = 2500.0;  // [kg/m3]

double kinetic(double f) {
  return kinetic_pressure(f, theta, e, RadialPaper::value(f, {paper.solid_fraction_max}), rho_s);
}

TEST(SolidPressure, WithoutThetaOnlyTheElasticPartIsLeft) {
  for (const double f : {0.0, 0.3, 0.57, 0.6, 0.64}) {
    EXPECT_EQ(solid_pressure(f, 0.0, e, rho_s, paper, true).value, elastic_pressure(f, paper).value) << f;
    EXPECT_EQ(enduring_pressure(f, 0.0, e, rho_s, paper, true), elastic_pressure(f, paper).value) << f;
  }
}

TEST(SolidPressure, KineticAndDensePartTogetherAreTheLarger) {
  for (double f = 0.01; f < 0.66; f += 0.01) {
    const double dense = dense_pressure(f, theta, e, rho_s, paper).value;
    const double expected = elastic_pressure(f, paper).value + std::max(kinetic(f), dense);
    EXPECT_NEAR(solid_pressure(f, theta, e, rho_s, paper, true).value, expected, 1e-12 * expected) << f;
    EXPECT_NEAR(solid_pressure(f, theta, e, rho_s, paper, false).value,
                elastic_pressure(f, paper).value + kinetic(f), 1e-12 * expected)
        << f;
  }
}

TEST(SolidPressure, DenseFlowPressureTakesOverInADenseBed) {
  // The check above must see both cases.
  EXPECT_LT(dense_pressure(0.3, theta, e, rho_s, paper).value, kinetic(0.3));
  EXPECT_GT(dense_pressure(0.59, theta, e, rho_s, paper).value, kinetic(0.59));
}

TEST(SolidPressure, EnduringPartIsWhatKineticTheoryLeaves) {
  for (const bool dense_excess : {true, false}) {
    for (double f = 0.01; f < 0.66; f += 0.01) {
      const double total = solid_pressure(f, theta, e, rho_s, paper, dense_excess).value;
      EXPECT_NEAR(enduring_pressure(f, theta, e, rho_s, paper, dense_excess), total - kinetic(f),
                  1e-12 * total)
          << f;
    }
  }
}

// Grains at rest in a partly filled cell: the largest of three claims; friction gets what kinetic theory
// leaves.
TEST(SolidPressure, RestingWeightIsAThirdClaimant) {
  const double resting = 1.2;  // [Pa]
  double previous = 0.0;
  bool kinetic_wins = false, weight_wins = false, dense_wins = false;
  for (double f = 0.01; f < 0.64; f += 0.002) {
    const double dense = dense_pressure(f, theta, e, rho_s, paper).value;
    const double expected = std::max({kinetic(f), dense, resting});
    const double elastic = elastic_pressure(f, paper).value;
    const PressureAndSlope p = solid_pressure(f, theta, e, rho_s, paper, true, resting);
    EXPECT_NEAR(p.value, elastic + expected, 1e-12 * p.value) << f;
    EXPECT_NEAR(enduring_pressure(f, theta, e, rho_s, paper, true, resting), elastic + expected - kinetic(f),
                1e-12 * p.value)
        << f;
    EXPECT_GE(p.value, previous) << f;
    previous = p.value;
    kinetic_wins = kinetic_wins || expected == kinetic(f);
    weight_wins = weight_wins || expected == resting;
    dense_wins = dense_wins || expected == dense;
  }
  EXPECT_TRUE(kinetic_wins && weight_wins && dense_wins);
  EXPECT_NEAR(solid_pressure(0.3, 0.0, e, rho_s, paper, true, resting).value, 1.2, 1e-12);
  EXPECT_EQ(solid_pressure(0.3, 0.0, e, rho_s, paper, true, resting).slope, 0.0);
  EXPECT_NEAR(enduring_pressure(0.3, 0.0, e, rho_s, paper, false, resting), 1.2, 1e-12);
}

TEST(SolidPressure, SlopeIsTheDerivative) {
  for (const bool dense_excess : {true, false}) {
    const auto pressure = [dense_excess](double f) {
      return solid_pressure(f, theta, e, rho_s, paper, dense_excess).value;
    };
    for (const double f : {0.1, 0.3, 0.5, 0.56, 0.575, 0.59, 0.6, 0.61, 0.625, 0.64}) {
      const double expected = test::derivative(pressure, f, 1e-5);
      EXPECT_NEAR(solid_pressure(f, theta, e, rho_s, paper, dense_excess).slope, expected, 1e-5 * expected)
          << f << (dense_excess ? " with" : " without") << " dense-flow excess";
    }
  }
}

TEST(SolidPressure, OfColdGrainsApartIsNone) {
  for (double f = 0.005; f < 0.7; f += 0.01) {
    const PressureAndSlope p = solid_pressure(f, 0.0, e, rho_s, paper, true);
    const bool touching = f > paper.solid_fraction_min;
    EXPECT_EQ(p.value > 0.0, touching) << f;
    EXPECT_EQ(p.slope > 0.0, touching) << f;
    EXPECT_GE(p.slope, 0.0) << f;
  }
}

TEST(SolidPressure, IsContinuousAndDoesNotFall) {
  for (const bool dense_excess : {true, false}) {
    double previous = 0.0;
    for (double f = 1e-5; f < 0.66; f += 1e-5) {
      const PressureAndSlope p = solid_pressure(f, theta, e, rho_s, paper, dense_excess);
      ASSERT_GE(p.value, previous * (1.0 - 1e-14)) << f;
      ASSERT_LE(p.value - previous, 2e-5 * p.slope + 1e-3 * p.value + 1e-6) << f;
      previous = p.value;
    }
  }
}

}  // namespace
}  // namespace granvof::closures
