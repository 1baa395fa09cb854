#include <cmath>

#include <gtest/gtest.h>

#include "compare/metrics/base_pressure.hpp"
#include "compare/metrics/bed_slope.hpp"
#include "compare/metrics/conservation.hpp"
#include "compare/metrics/dam_break.hpp"
#include "compare/metrics/deposit_shape.hpp"
#include "compare/metrics/line_fit.hpp"
#include "compare/metrics/power_law.hpp"
#include "compare/metrics/run_out.hpp"
#include "compare/metrics/toe_drift.hpp"

namespace granvof::compare {
namespace {

constexpr ColumnSize column{0.0981, 9.81};  // tau0 = 0.1 s

Curve ramp(double start, double speed, double end = 1.0) {
  Curve curve;
  for (int i = 0; i <= 100; ++i) {
    curve.time.push_back(end * i / 100.0);
    curve.value.push_back(start + speed * curve.time.back());
  }
  return curve;
}

TEST(RunOut, ScalesByHeightAndTimeFromTheMeasuredStart) {
  const Curve scaled = run_out(ramp(0.2, 0.0981), column);
  EXPECT_NEAR(*value_at(scaled, 0.0), 0.0, 1e-14);
  EXPECT_NEAR(*value_at(scaled, 5.0), 0.5, 1e-12);
}

TEST(RunOut, AFrontUndefinedAtTheStartGivesNoCurve) {
  Curve late = ramp(0.2, 0.1);
  late.time.erase(late.time.begin());
  late.value.erase(late.value.begin());
  EXPECT_TRUE(run_out(late, column).empty());
}

TEST(RmsDistance, OfShiftedLinesIsTheShift) {
  EXPECT_NEAR(*rms_distance(ramp(0.0, 1.0), ramp(0.25, 1.0, 0.999), {0.0, 0.9}), 0.25, 1e-12);
}

TEST(RmsDistance, OfALinearDifferenceIsItsEndOverRootThree) {
  // The difference is sampled, so the trapezoidal rule on its square is off by O(1/n^2).
  EXPECT_NEAR(*rms_distance(ramp(0.0, 0.0), ramp(0.0, 1.0), {0.0, 1.0}), 1.0 / std::sqrt(3.0), 1e-4);
}

TEST(RmsDistance, NeedsBothCurvesToCoverTheWindow) {
  EXPECT_FALSE(rms_distance(ramp(0.0, 1.0), ramp(0.0, 1.0, 0.5), {0.0, 1.0}));
}

TEST(BasePressure, PeakKeepsItsSign) {
  const Curve excess = excess_pressure({{0.0, 0.1, 0.2}, {700.0, 400.0, 750.0}}, 700.0);
  EXPECT_DOUBLE_EQ(*peak_pressure(excess, {0.0, 1.0}), -300.0);
  EXPECT_FALSE(peak_pressure(excess, {1.0, 2.0}));
}

TEST(BasePressure, SignIsThatOfTheIntegral) {
  // One sharp negative spike in a positive signal does not decide.
  const Curve excess{{0.0, 0.01, 0.02, 0.03, 1.0}, {50.0, 50.0, -200.0, 50.0, 50.0}};
  EXPECT_DOUBLE_EQ(*onset_sign(excess, {0.0, 1.0}, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(*onset_sign(excess, {0.0, 1.0}, 100.0), 0.0);
  EXPECT_DOUBLE_EQ(*onset_sign(excess, {0.01, 0.03}, 1.0), -1.0);
}

TEST(LineFit, IsExactOnALineAndTheMeanOtherwise) {
  const Line exact = line_fit({1.0, 2.0, 4.0}, {5.0, 7.0, 11.0});
  EXPECT_NEAR(exact.offset, 3.0, 1e-12);
  EXPECT_NEAR(exact.slope, 2.0, 1e-12);
  EXPECT_NEAR(line_fit({-1.0, 0.0, 1.0}, {0.0, 3.0, 0.0}).offset, 1.0, 1e-12);
}

TEST(PowerLaw, FindsItsOwnParameters) {
  Curve curve;
  for (int i = 0; i <= 50; ++i) {  // t = 0 has no logarithm and is left out
    curve.time.push_back(0.1 * i);
    curve.value.push_back(0.3 * std::pow(0.1 * i, 0.7));
  }
  const auto fit = power_law(curve, {0.0, 5.0});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->factor, 0.3, 1e-12);
  EXPECT_NEAR(fit->exponent, 0.7, 1e-12);
  EXPECT_FALSE(power_law(curve, {0.0, 0.1}));
}

// A front that stands at the far wall, or has come back from it, is no run-out.
TEST(PowerLaw, EndsAtTheFarWall) {
  Curve curve;
  for (int i = 1; i <= 50; ++i) {
    const double free = 0.3 * std::pow(0.1 * i, 0.7), x = i < 45 ? std::fmin(free, 0.8) : 0.7;
    curve.time.push_back(0.1 * i);
    curve.value.push_back(x);
  }
  const Curve free = before_wall(curve, 0.8, 0.0025);
  ASSERT_FALSE(free.empty());
  EXPECT_DOUBLE_EQ(free.time.back(), 4.0);  // 0.3 t^0.7 passes 0.7975 at 4.04
  const auto fit = power_law(free, {0.5, 5.0});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 0.7, 1e-12);
  EXPECT_LT(power_law(curve, {0.5, 5.0})->exponent, 0.68);
  EXPECT_EQ(before_wall(curve, 2.0, 0.0025).size(), curve.size());
  Curve in_the_last_cell;
  in_the_last_cell.time = {0.0, 1.0};
  in_the_last_cell.value = {0.5, 0.799};
  EXPECT_EQ(before_wall(in_the_last_cell, 0.8, 0.0025).size(), 1U);
}

BedProfile profile_of(double top, double base, int columns) {
  BedProfile profile;
  const double dx = 2.0 * base / columns;
  for (int i = 0; i < columns; ++i) {
    const double x = (i + 0.5) * dx;
    profile.x.push_back(x);
    profile.height.push_back(x < top ? 1.0 : std::max(0.0, (base - x) / (base - top)));
  }
  return profile;
}

TEST(DepositShape, TriangleAndTrapezoidHaveTheirExactShares) {
  // Fine enough that the kinks, which fall between columns, do not matter.
  const auto triangle = deposit_shape(profile_of(0.0, 1.0, 20000));
  const auto trapezoid = deposit_shape(profile_of(0.4, 1.0, 20000));
  ASSERT_TRUE(triangle && trapezoid);
  EXPECT_NEAR(triangle->flat_top, 0.05 / 0.95, 1e-3);
  EXPECT_NEAR(trapezoid->flat_top, (0.4 + 0.05 * 0.6) / (1.0 - 0.05 * 0.6), 1e-3);
  EXPECT_NEAR(trapezoid->length, 0.97, 1e-3);
}

// Against a wall the profile goes on over the last half column: all four columns, or three and what rises to
// the first.
TEST(DepositShape, GoesOnToTheWallsOfTheTank) {
  EXPECT_NEAR(deposit_shape({{0.5, 1.5, 2.5, 3.5}, {1.0, 1.0, 1.0, 1.0}})->length, 4.0, 1e-12);
  EXPECT_NEAR(deposit_shape({{0.5, 1.5, 2.5, 3.5}, {0.0, 1.0, 1.0, 1.0}})->length, 3.45, 1e-12);
  EXPECT_NEAR(deposit_shape({{0.5, 1.5, 2.5, 3.5}, {1.0, 1.0, 1.0, 0.0}})->length, 3.45, 1e-12);
}

TEST(DepositShape, OfAnEmptyBedIsUndefined) {
  EXPECT_FALSE(deposit_shape({{0.5, 1.5}, {0.0, 0.0}}));
  EXPECT_FALSE(deposit_shape({}));
}

TEST(BedProfile, StacksTheSolidsOfAColumn) {
  // 2 x 3 x 2 cells, index (k ny + j) nx + i; a smeared surface counts by its solids.
  const std::vector<double> f_s{0.5, 0.0, 0.5, 0.0, 0.25, 0.0, 0.5, 0.0, 0.5, 0.0, 0.0, 0.25};
  const BedProfile profile = bed_profile(f_s, {2, 3, 2}, {0.1, 0.2, 0.3}, 0.5);
  EXPECT_NEAR(profile.x[1], 0.15, 1e-15);
  EXPECT_NEAR(profile.height[0], 0.2 / (0.5 * 2) * 2.25, 1e-15);
  EXPECT_NEAR(profile.height[1], 0.2 / (0.5 * 2) * 0.25, 1e-15);
}

TEST(Conservation, ErrorIsTheLargestAtAnyTime) {
  EXPECT_NEAR(*volume_error({{0.0, 1.0, 2.0}, {2.0, 2.2, 2.0}}), 0.1, 1e-15);
  EXPECT_FALSE(volume_error({{0.0}, {0.0}}));
  EXPECT_FALSE(volume_error({}));
}

TEST(BedSlope, DriftIsEndLessBegin) {
  EXPECT_NEAR(*slope_change({{0.0, 10.0, 40.0}, {14.0, 12.5, 12.0}}, {10.0, 40.0}), -0.5, 1e-15);
  EXPECT_FALSE(slope_change({{0.0, 10.0}, {14.0, 12.5}}, {10.0, 40.0}));
}

TEST(ToeDrift, IsTheLargestMoveAtAnyTimeOfTheWindow) {
  const Curve toe{{0.0, 4.0, 10.0, 20.0, 40.0}, {0.20, 0.25, 0.27, 0.24, 0.26}};
  EXPECT_NEAR(*largest_move(toe, {4.0, 40.0}), 0.02, 1e-15);   // out and back counts
  EXPECT_NEAR(*largest_move(toe, {10.0, 20.0}), 0.03, 1e-15);  // so does a toe that draws back
  EXPECT_NEAR(*largest_move(toe, {4.0, 7.0}), 0.01, 1e-15);    // ends between samples
  EXPECT_FALSE(largest_move(toe, {4.0, 50.0}));
}

TEST(DamBreak, ScalesLikeMartinAndMoyce) {
  const Curve front = dam_break_front({{0.0, 1.0}, {0.05, 0.1}}, 0.05, 9.81, 0.175);
  EXPECT_NEAR(front.time[1], std::sqrt(2.0 * 9.81 / 0.05) + 0.175, 1e-12);
  EXPECT_NEAR(front.value[1], 2.0, 1e-12);
}

}  // namespace
}  // namespace granvof::compare
