// Radial distribution function, eq (19) as corrected.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/radial_distribution.hpp"
#include "solver/tests/closures/derivative.hpp"

namespace granvof::closures {
namespace {

constexpr double f_max = 0.63;

TEST(RadialDistribution, Values) {
  EXPECT_EQ(radial_distribution(0.0, f_max), 1.0);  // grains far apart do not feel each other
  EXPECT_NEAR(radial_distribution(0.3, 0.6), 0.86875 / 0.25, 1e-14);
  EXPECT_NEAR(radial_distribution(0.57, f_max), 0.750625 * 441.0 / 4.0, 1e-10);  // 1 - 0.57/0.63 = 2/21
}

// Denser than 0.98 f_s,max the gap is taken as 0.02.
TEST(RadialDistribution, ValueAtTheCap) {
  EXPECT_NEAR(radial_distribution(f_max, f_max), (1.0 - 0.4375 * f_max) / 4e-4, 1e-9);
}

TEST(RadialDistribution, DiluteSlopeIsNearTheSecondVirialCoefficientOfHardSpheres) {
  EXPECT_NEAR(radial_distribution_slope(0.0, f_max), 2.5, 0.25);  // exact: 5/2; (19) gives 2.74
}

TEST(RadialDistribution, GrowsUpToTheCap) {
  const double cap = f_max * (1.0 - radial_distribution_cap);
  double previous = 0.0;
  for (double f = 0.0; f < cap; f += 0.01) {
    EXPECT_GT(radial_distribution(f, f_max), previous);
    previous = radial_distribution(f, f_max);
  }
}

TEST(RadialDistribution, IsFiniteAtAndBeyondTheDensestPacking) {
  for (const double f : {0.63, 0.66, 1.0}) {
    EXPECT_TRUE(std::isfinite(radial_distribution(f, f_max)));
    EXPECT_GT(radial_distribution(f, f_max), 1000.0);
    EXPECT_TRUE(std::isfinite(radial_distribution_slope(f, f_max)));
  }
  const double cap = f_max * (1.0 - radial_distribution_cap);
  EXPECT_NEAR(radial_distribution(cap - 1e-12, f_max), radial_distribution(cap + 1e-12, f_max), 1e-5);
}

TEST(RadialDistribution, SlopeIsTheDerivative) {
  const auto g0 = [](double f) { return radial_distribution(f, f_max); };
  for (const double f : {0.1, 0.3, 0.5, 0.57, 0.6, 0.61, 0.625, 0.65}) {
    const double expected = test::derivative(g0, f, 1e-5);
    EXPECT_NEAR(radial_distribution_slope(f, f_max), expected, 1e-6 * std::abs(expected)) << f;
  }
}

}  // namespace
}  // namespace granvof::closures
