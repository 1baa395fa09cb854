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

}  // namespace
}  // namespace granvof::compare
