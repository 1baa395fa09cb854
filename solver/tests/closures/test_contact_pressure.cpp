// Pressure of enduring contacts: elastic (13), dense flow (15).
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/contact_pressure.hpp"
#include "solver/tests/closures/derivative.hpp"

namespace granvof::closures {
namespace {

const Contact paper;  // f_s,min 0.57, f_s,max 0.63, K 1e8 Pa, chi 1.5, a' 0.28, delta 0.58, f_s0 0.60

TEST(ElasticPressure, ValuesOfThePrintedForm) {
  EXPECT_NEAR(elastic_pressure(0.585, paper).value, 31477.63328252745, 1e-6);   // sine = -1/sqrt(2)
  EXPECT_NEAR(elastic_pressure(0.600, paper).value, 311769.1453623979, 1e-5);   // sine = 0
  EXPECT_NEAR(elastic_pressure(0.630, paper).value, 1851814.2455440825, 1e-4);  // sine = 1
}

TEST(ElasticPressure, IsZeroBelowRandomLoosePacking) {
  for (const double f : {0.0, 0.3, 0.5699, 0.57}) {
    EXPECT_EQ(elastic_pressure(f, paper).value, 0.0) << f;
    EXPECT_EQ(elastic_pressure(f, paper).slope, 0.0) << f;
  }
  EXPECT_GT(elastic_pressure(0.5701, paper).value, 0.0);
}

TEST(ElasticPressure, StartsWithoutAKink) {
  // Near f_s,min the ramp is quadratic: P ~ (f - f_min)^3.5, so that value and slope begin at zero.
  const double ratio =
      elastic_pressure(0.57 + 2e-5, paper).value / elastic_pressure(0.57 + 1e-5, paper).value;
  EXPECT_NEAR(ratio, std::pow(2.0, 3.5), 1e-3);
}

TEST(ElasticPressure, CarriesTheBedOfS1JustAboveLoosePacking) {
  // Submerged weight of the column s1 at its base: 0.57 * 1500 * 9.81 * 0.049 = 411 Pa.
  EXPECT_LT(elastic_pressure(0.573, paper).value, 411.0);
  EXPECT_GT(elastic_pressure(0.575, paper).value, 411.0);
}

TEST(ElasticPressure, DoesNotFallBeyondTheDensestPacking) {
  double previous = elastic_pressure(0.62, paper).value;
  for (double f = 0.622; f < 0.70; f += 0.002) {
    EXPECT_GT(elastic_pressure(f, paper).value, previous) << f;
    previous = elastic_pressure(f, paper).value;
  }
  EXPECT_NEAR(elastic_pressure(0.63 - 1e-10, paper).value, elastic_pressure(0.63 + 1e-10, paper).value, 0.1);
}

TEST(ElasticPressure, SlopeIsTheDerivative) {
  const auto pressure = [](double f) { return elastic_pressure(f, paper).value; };
  for (const double f : {0.571, 0.574, 0.59, 0.61, 0.629, 0.64, 0.66}) {
    const double expected = test::derivative(pressure, f, 1e-5);
    EXPECT_NEAR(elastic_pressure(f, paper).slope, expected, 1e-6 * expected) << f;
  }
}

TEST(ElasticPressure, IsProportionalToStiffness) {
  Contact soft = paper;
  soft.stiffness = 1e6;
  EXPECT_NEAR(elastic_pressure(0.6, soft).value, 0.01 * elastic_pressure(0.6, paper).value, 1e-9);
}

TEST(DensePressure, Value) {
  // 15 * 2500 * 1e-4 * 0.2 * (0.28 * 0.5 * 0.6 / 0.1)^(2 / 0.58) = 0.75 * 0.84^3.448
  EXPECT_NEAR(dense_pressure(0.5, 1e-4, 0.8, 2500.0, paper).value, 0.4111074558862429, 1e-12);
}

// Closer than 0.005 to f_s0 that is taken: 15 * 2500 * 1e-4 * 0.2 * (0.28 * 0.6 * 0.6 / 0.005)^(2 / 0.58).
TEST(DensePressure, ValueAtItsSingularity) {
  EXPECT_NEAR(dense_pressure(0.6, 1e-4, 0.8, 2500.0, paper).value, 0.75 * std::pow(20.16, 2.0 / 0.58), 1e-6);
}

TEST(DensePressure, VanishesWithGrainsWithThetaAndForElasticGrains) {
  EXPECT_EQ(dense_pressure(0.0, 1.0, 0.5, 2500.0, paper).value, 0.0);
  EXPECT_EQ(dense_pressure(0.5, 0.0, 0.5, 2500.0, paper).value, 0.0);
  EXPECT_EQ(dense_pressure(0.5, 1.0, 1.0, 2500.0, paper).value, 0.0);
  EXPECT_LT(dense_pressure(1e-6, 1.0, 0.5, 2500.0, paper).value, 1e-10);
}

TEST(DensePressure, IsFiniteAtAndBeyondItsSingularity) {
  const double cap = paper.dense_solid_fraction - dense_pressure_cap;
  const auto pressure = [](double f) { return dense_pressure(f, 1e-4, 0.5, 2500.0, paper).value; };
  EXPECT_NEAR(pressure(cap - 1e-12), pressure(cap + 1e-12), 1e-6 * pressure(cap));
  double previous = 0.0;
  for (double f = 0.01; f < 0.67; f += 0.005) {
    EXPECT_TRUE(std::isfinite(pressure(f)));
    EXPECT_GT(pressure(f), previous) << f;
    previous = pressure(f);
  }
  // Past the cap only the leading f_s of the bracket grows.
  EXPECT_NEAR(pressure(0.63) / pressure(0.60), std::pow(0.63 / 0.60, 2.0 / 0.58), 1e-12);
}

TEST(DensePressure, SlopeIsTheDerivative) {
  const auto pressure = [](double f) { return dense_pressure(f, 1e-4, 0.5, 2500.0, paper).value; };
  for (const double f : {0.05, 0.3, 0.5, 0.57, 0.59, 0.6, 0.63}) {
    const double expected = test::derivative(pressure, f, 1e-5);
    EXPECT_NEAR(dense_pressure(f, 1e-4, 0.5, 2500.0, paper).slope, expected, 1e-6 * expected) << f;
  }
}

}  // namespace
}  // namespace granvof::closures
