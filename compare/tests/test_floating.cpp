#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "compare/metrics/decay_rate.hpp"
#include "compare/metrics/immersion.hpp"
#include "compare/metrics/period.hpp"

namespace granvof::compare {
namespace {

template <typename Function>
Curve sampled(double end, int samples, Function function) {
  Curve curve;
  for (int i = 0; i <= samples; ++i) {
    curve.time.push_back(end * i / samples);
    curve.value.push_back(function(curve.time.back()));
  }
  return curve;
}

Curve constant(double value) {
  return sampled(6.0, 60, [&](double) { return value; });
}

TEST(Immersion, ABedDeeperInTheWaterIsMoreImmersed) {
  // Bed of height 0.1 centred 0.03 above the interface: 0.02 of it is below.
  const auto high = immersion(constant(0.13), constant(0.1), constant(0.10), {3.0, 6.0});
  ASSERT_TRUE(high);
  EXPECT_NEAR(high->share(), 0.2, 1e-12);
  const auto deep = immersion(constant(0.07), constant(0.1), constant(0.10), {3.0, 6.0});
  EXPECT_NEAR(deep->share(), 0.8, 1e-12);
}

TEST(Immersion, IsUndefinedWhileTheBedIsLoose) {
  EXPECT_FALSE(immersion(Curve{}, constant(0.1), constant(0.1), {3.0, 6.0}));
  EXPECT_FALSE(immersion(constant(0.1), constant(0.1), Curve{}, {3.0, 6.0}));
}

TEST(Period, OfADampedSineOnAnOffset) {
  const Curve curve = sampled(6.0, 600, [](double t) {
    return 0.1 + 0.01 * std::exp(-0.1 * t) * std::sin(2.0 * std::numbers::pi * t / 0.374);
  });
  const auto found = oscillation(curve, {1.0, 6.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, 0.374, 0.374 * 1e-3);
  EXPECT_GE(found->cycles, 12);
}

TEST(Period, RipplesOnAFlankAreNotCycles) {
  const Curve curve = sampled(10.0, 5000, [](double t) {
    return std::sin(2.0 * std::numbers::pi * t) + 0.08 * std::sin(2.0 * std::numbers::pi * 20.0 * t);
  });
  const auto found = oscillation(curve, {0.0, 10.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, 1.0, 0.01);
}

TEST(Period, AmplitudeIsHalfOfTheRange) {
  const Curve curve =
      sampled(10.0, 5000, [](double t) { return 0.1 + 0.03 * std::sin(2.0 * std::numbers::pi * t); });
  EXPECT_NEAR(oscillation(curve, {0.0, 10.0})->amplitude, 0.03, 1e-6);
}

// Late cycles of 0.7 rms are cycles: only what stays within 0.2 rms is a ripple.
TEST(Period, CyclesThatHaveDecayedCount) {
  const Curve curve = sampled(10.0, 5000, [](double t) {
    return (t < 3.0 ? 1.0 : 0.3) * std::sin(2.0 * std::numbers::pi * (t - 0.25));
  });
  const auto found = oscillation(curve, {0.0, 10.0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cycles, 9);  // between upward crossings at 0.25 and 9.25
  EXPECT_NEAR(found->period, 1.0, 0.01);
}

// The level beside the wall of a tank after a step at its middle, by linear theory (as cases/sloshing.toml):
// odd modes, the n-th an n-th as high. Crossings take the other modes along, the fit hardly.
TEST(Period, OfTheFirstModeAmongOthers) {
  const auto speed = [](int n) {  // of the mode's phase [1/s]
    const double k = n * std::numbers::pi / 0.1;
    return std::sqrt(9.81 * k * std::tanh(0.05 * k));
  };
  const Curve level = sampled(1.5, 150, [&](double t) {
    double sum = 0.05;
    for (int n = 1; n < 41; n += 2) sum += (n % 4 == 1 ? 1.0 : -1.0) * 0.0032 / n * std::cos(speed(n) * t);
    return sum;
  });
  const double first = 2.0 * std::numbers::pi / speed(1);
  EXPECT_GT(std::fabs(oscillation(level, {0.0, 1.5})->period / first - 1.0), 0.01);
  EXPECT_NEAR(*fitted_period(level, {0.0, 1.5}), first, 0.005 * first);
  const Curve alone = sampled(1.5, 150, [&](double t) { return 0.05 + 0.0032 * std::sin(speed(1) * t); });
  EXPECT_NEAR(*fitted_period(alone, {0.0, 1.5}), first, 1e-6 * first);
}

TEST(Period, NeedsTwoCycles) {
  const auto sine = [](double t) { return std::sin(2.0 * std::numbers::pi * t / 4.0); };
  EXPECT_FALSE(fitted_period(sampled(6.0, 600, sine), {0.0, 6.0}));
  EXPECT_FALSE(fitted_period(constant(1.0), {0.0, 6.0}));
  EXPECT_FALSE(oscillation(sampled(6.0, 600, sine), {0.0, 6.0}));
  EXPECT_FALSE(oscillation(constant(1.0), {0.0, 6.0}));
  EXPECT_FALSE(oscillation(Curve{}, {0.0, 6.0}));
}

TEST(DecayRate, OfAnExponentialApproachFromEitherSide) {
  for (const double amplitude : {-0.02, 0.02}) {
    const Curve curve = sampled(4.0, 400, [&](double t) { return 0.05 + amplitude * std::exp(-2.4 * t); });
    EXPECT_NEAR(*approach_rate(curve, {0.5, 2.0}, 0.05), 2.4, 1e-9);
  }
}

TEST(DecayRate, IsTakenWhereTheMotionIsResolved) {
  // Twice as fast once the deviation is below 0.01.
  const double change = std::log(5.0);
  const Curve curve = sampled(4.0, 4000, [&](double t) {
    return t < change ? 0.05 * std::exp(-t) : 0.01 * std::exp(-2.0 * (t - change));
  });
  EXPECT_NEAR(*approach_rate(resolved_part(curve, 0.0, 0.01), {0.0, 4.0}, 0.0), 1.0, 1e-9);
  EXPECT_GT(*approach_rate(curve, {0.0, 4.0}, 0.0), 1.3);
  EXPECT_TRUE(resolved_part(curve, 0.0, 0.06).empty());
}

TEST(DecayRate, IsUndefinedWhereTheDeviationChangesSign) {
  const Curve curve = sampled(4.0, 400, [](double t) { return std::exp(-t); });
  EXPECT_FALSE(approach_rate(curve, {0.0, 2.0}, 0.5));
  EXPECT_FALSE(approach_rate(constant(0.5), {0.0, 2.0}, 0.5));
  EXPECT_FALSE(approach_rate(curve, {0.0, 0.01}, 0.0));
  EXPECT_FALSE(approach_rate(Curve{}, {0.0, 2.0}, 0.0));
}

TEST(DecayRate, EnvelopeOfADampedOscillation) {
  const Curve curve = sampled(6.0, 6000, [](double t) {
    return 0.1 + 0.01 * std::exp(-0.5 * t) * std::cos(2.0 * std::numbers::pi * t / 0.3);
  });
  EXPECT_NEAR(*envelope_decay_rate(curve, {0.0, 6.0}), 0.5, 0.01);
  // a window that begins just before a crossing has hardly anything of its first half cycle
  EXPECT_NEAR(*envelope_decay_rate(curve, {0.07, 6.0}), 0.5, 0.01);
  EXPECT_FALSE(envelope_decay_rate(constant(0.1), {0.0, 6.0}));
}

}  // namespace
}  // namespace granvof::compare
