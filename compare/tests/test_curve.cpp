#include <gtest/gtest.h>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {
namespace {

const Curve line{{0.0, 1.0, 3.0}, {1.0, 3.0, 7.0}};  // y = 1 + 2 t

TEST(Curve, InterpolatesButDoesNotExtrapolate) {
  EXPECT_DOUBLE_EQ(*value_at(line, 2.0), 5.0);
  EXPECT_DOUBLE_EQ(*value_at(line, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(*value_at(line, 3.0), 7.0);
  EXPECT_FALSE(value_at(line, 3.1));
  EXPECT_FALSE(value_at(line, -0.1));
  EXPECT_FALSE(value_at(Curve{}, 0.0));
}

TEST(Curve, EndReachedToRoundingCounts) {
  EXPECT_DOUBLE_EQ(*value_at(line, 3.0 + 1e-10), 7.0);
}

TEST(Curve, IntegralAndTimeMeanWeighBySpacing) {
  EXPECT_DOUBLE_EQ(*integral(line), 12.0);
  EXPECT_DOUBLE_EQ(*time_mean(line), 4.0);  // the plain mean of the samples would be 11/3
  EXPECT_FALSE(integral(Curve{{1.0}, {2.0}}));
}

// What lies between is not known, and is not made up.
TEST(Curve, IsNotJoinedAcrossAGap) {
  Curve gapped{{0.0, 1.0, 4.0, 5.0}, {0.0, 1.0, 4.0, 5.0}};
  EXPECT_DOUBLE_EQ(*value_at(gapped, 2.5), 2.5);
  gapped.widest = 1.5;
  EXPECT_FALSE(value_at(gapped, 2.5));
  EXPECT_DOUBLE_EQ(*value_at(gapped, 1.0), 1.0);  // the samples themselves are known
  EXPECT_DOUBLE_EQ(*value_at(gapped, 4.0), 4.0);
  EXPECT_DOUBLE_EQ(*value_at(gapped, 4.5), 4.5);
  EXPECT_FALSE(integral(gapped));
  EXPECT_FALSE(time_mean(clip(gapped, {0.5, 4.5})));
  EXPECT_DOUBLE_EQ(*integral(clip(gapped, {4.0, 5.0})), 4.5);
}

TEST(Curve, ClipKeepsBothEnds) {
  const Curve inside = clip(line, {1.0, 3.0});
  EXPECT_EQ(inside.time, (std::vector<double>{1.0, 3.0}));
  EXPECT_TRUE(clip(line, {4.0, 5.0}).empty());
}

TEST(Curve, ExtremesOfNothingAreUndefined) {
  EXPECT_DOUBLE_EQ(*maximum(line), 7.0);
  EXPECT_DOUBLE_EQ(*minimum(line), 1.0);
  EXPECT_FALSE(maximum(Curve{}));
  EXPECT_FALSE(minimum(Curve{}));
}

// Two records whose column is not quite as high have other time scales: the mean reaches to the end of the
// shorter, whichever comes first.
TEST(Curve, MeanEndsWhereTheShorterEnds) {
  const Curve shorter{.time = {0.0, 1.0, 2.0}, .value = {0.0, 1.0, 2.0}, .widest = 1.5};
  const Curve longer{.time = {0.0, 1.01, 2.02}, .value = {0.0, 2.02, 4.04}, .widest = 1.5};
  for (const auto& curves : {std::vector{shorter, longer}, std::vector{longer, shorter}}) {
    const Curve mean = mean_curve(curves);
    ASSERT_FALSE(mean.empty());
    EXPECT_DOUBLE_EQ(mean.time.back(), 2.0);
    EXPECT_NEAR(value_at(mean, 2.0).value(), 3.0, 1e-12);
    EXPECT_NEAR(value_at(mean, 1.5).value(), 2.25, 1e-12);
  }
}

}  // namespace
}  // namespace granvof::compare
