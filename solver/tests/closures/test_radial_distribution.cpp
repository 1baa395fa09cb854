// Radial distribution function, eq (19) as corrected.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/tests/closures/derivative.hpp"

namespace granvof::closures {
namespace {

constexpr double f_max = 0.63;

TEST(RadialDistribution, Values) {
  EXPECT_EQ(RadialPaper::value(0.0, {f_max}), 1.0);  // grains far apart do not feel each other
  EXPECT_NEAR(RadialPaper::value(0.3, {0.6}), 0.86875 / 0.25, 1e-14);
  EXPECT_NEAR(RadialPaper::value(0.57, {f_max}), 0.750625 * 441.0 / 4.0, 1e-10);  // 1 - 0.57/0.63 = 2/21
}

// Denser than 0.98 f_s,max the gap is taken as 0.02.
TEST(RadialDistribution, ValueAtTheCap) {
  EXPECT_NEAR(RadialPaper::value(f_max, {f_max}), (1.0 - 0.4375 * f_max) / 4e-4, 1e-9);
}

TEST(RadialDistribution, DiluteSlopeIsNearTheSecondVirialCoefficientOfHardSpheres) {
  EXPECT_NEAR(RadialPaper::slope(0.0, {f_max}), 2.5, 0.25);  // exact: 5/2; (19) gives 2.74
}

TEST(RadialDistribution, GrowsUpToTheCap) {
  const double cap = f_max * (1.0 - radial_distribution_cap);
  double previous = 0.0;
  for (double f = 0.0; f < cap; f += 0.01) {
    EXPECT_GT(RadialPaper::value(f, {f_max}), previous);
    previous = RadialPaper::value(f, {f_max});
  }
}

TEST(RadialDistribution, IsFiniteAtAndBeyondTheDensestPacking) {
  for (const double f : {0.63, 0.66, 1.0}) {
    EXPECT_TRUE(std::isfinite(RadialPaper::value(f, {f_max})));
    EXPECT_GT(RadialPaper::value(f, {f_max}), 1000.0);
    EXPECT_TRUE(std::isfinite(RadialPaper::slope(f, {f_max})));
  }
  const double cap = f_max * (1.0 - radial_distribution_cap);
  EXPECT_NEAR(RadialPaper::value(cap - 1e-12, {f_max}), RadialPaper::value(cap + 1e-12, {f_max}), 1e-5);
}

TEST(RadialDistribution, SlopeIsTheDerivative) {
  const auto g0 = [](double f) { return RadialPaper::value(f, {f_max}); };
  for (const double f : {0.1, 0.3, 0.5, 0.57, 0.6, 0.61, 0.625, 0.65}) {
    const double expected = test::derivative(g0, f, 1e-5);
    EXPECT_NEAR(RadialPaper::slope(f, {f_max}), expected, 1e-6 * std::abs(expected)) << f;
  }
}

// Smooth spheres: worked out by hand at 0.536, where the gap to 0.636 is 0.1.
TEST(JammingRadialDistribution, Values) {
  const double smooth = jamming_amplitude(0.0);
  EXPECT_DOUBLE_EQ(smooth, 0.58);
  EXPECT_EQ(RadialJamming::value(0.0, {0.636, smooth}), 1.0);
  const double dilute = 1.464 / (2.0 * 0.464 * 0.464 * 0.464),
               dense = 0.58 * 0.536 * 0.536 / std::pow(0.1, 1.5);
  EXPECT_NEAR(RadialJamming::value(0.536, {0.636, smooth}), dilute + dense, 1e-12);
}

TEST(JammingRadialDistribution, DiluteSlopeIsTheSecondVirialCoefficientOfHardSpheres) {
  EXPECT_NEAR(RadialJamming::slope(0.0, {0.636, 0.58}), 2.5, 1e-14);
}

// Rubbing grains diverge faster, up to a limit: 3.7.
TEST(JammingRadialDistribution, AmplitudeGrowsWithFriction) {
  EXPECT_GT(jamming_amplitude(0.5), 3.0 * jamming_amplitude(0.0));
  EXPECT_NEAR(jamming_amplitude(100.0), 3.70, 1e-12);
}

TEST(JammingRadialDistribution, SlopeIsTheDerivativeAndItIsFiniteAndGrowsToTheCap) {
  const auto g0 = [](double f) { return RadialJamming::value(f, {0.636, 0.58}); };
  double previous = 0.0;
  for (const double f : {0.1, 0.3, 0.5, 0.57, 0.6, 0.615, 0.63, 0.65, 0.7}) {
    const double expected = test::derivative(g0, f, 1e-5);
    EXPECT_NEAR(RadialJamming::slope(f, {0.636, 0.58}), expected, 1e-6 * std::abs(expected)) << f;
    EXPECT_GT(g0(f), previous) << f;
    previous = g0(f);
  }
  EXPECT_TRUE(std::isfinite(g0(0.636)));
}

// What (19) fails: the published profile of sheared smooth spheres (Vescovi et al. 2014) is steady only if f
// Theta (1 + 2 (1 + e) f g0) is the same all over. f_s and Theta / U^2 of cases/published/vescovi2014 at y/H
// = 0.5 and 0.08, e = 0.7: 1.11, and 2.9 by (19).
TEST(JammingRadialDistribution, PublishedShearIsInBalance) {
  const auto ratio = [](auto g0) {
    const auto p = [&](double f, double theta) { return f * theta * (1.0 + 3.4 * f * g0(f)); };
    return p(0.5566, 2.34e-4) / p(0.3193, 2.76e-3);
  };
  EXPECT_NEAR(ratio([](double f) { return RadialJamming::value(f, {0.636, 0.58}); }), 1.0, 0.12);
  EXPECT_GT(ratio([](double f) { return RadialPaper::value(f, {0.636}); }), 2.5);
}

}  // namespace
}  // namespace granvof::closures
