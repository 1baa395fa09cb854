#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/output/extract_front.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;
using namespace granvof::scalar;

namespace {

constexpr double threshold = 0.95 * 0.57;

TEST(FrontDense, LiesBetweenTheCentresOfTheLastDenseCellAndTheNext) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 3}, {0, 2}, 0.6);
  fill(fields, fields.f_s, {3, 4}, {0, 1}, 0.5);  // the lowest row reaches farthest
  // Centres at 0.125 (0.6) and 0.175 (0.5).
  EXPECT_NEAR(*front_dense(fields, scene), 0.125 + 0.05 * (0.6 - threshold) / 0.1, 1e-14);
}

TEST(FrontDense, HalfwayValueGivesTheHalfwayPoint) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 3}, {0, 2}, threshold + 0.05);
  fill(fields, fields.f_s, {3, 8}, {0, 2}, threshold - 0.05);
  EXPECT_NEAR(*front_dense(fields, scene), 0.15, 1e-14);
}

TEST(FrontDense, ABedAtTheFarWallReachesTheWall) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {5, 8}, {0, 1}, 0.6);
  EXPECT_DOUBLE_EQ(*front_dense(fields, scene), 0.4);
}

TEST(FrontDense, IsUndefinedWithoutADenseCell) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(front_dense(fields, scene));
  EXPECT_FALSE(front_dense_mean(fields, scene));
  fill(fields, fields.f_s, {0, 3}, {0, 2}, 0.54);
  EXPECT_FALSE(front_dense(fields, scene));
  EXPECT_TRUE(front_dilute(fields, scene));
}

TEST(FrontDense, LeavesTheDetachedDiluteTailToFrontDilute) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 2}, {0, 2}, 0.6);
  fill(fields, fields.f_s, {5, 6}, {0, 1}, 0.4);
  EXPECT_NEAR(*front_dense(fields, scene), 0.075 + 0.05 * (0.6 - threshold) / 0.6, 1e-14);
  EXPECT_NEAR(*front_dilute(fields, scene), 0.275 + 0.05 * 0.1 / 0.4, 1e-14);
}

TEST(FrontDense, In3DIsTheLargestOverTheWidthBesideTheMean) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  const double dense = 2.0 * threshold;  // front half a cell beyond the centre
  for (int i = 0; i < 3; ++i) fields.f_s[cell_index(fields, i, 0, 0)] = dense;
  fields.f_s[cell_index(fields, 0, 0, 1)] = dense;
  EXPECT_NEAR(*front_dense(fields, scene), 0.3, 1e-14);
  EXPECT_NEAR(*front_dense_mean(fields, scene), 0.2, 1e-14);
  fields.f_s[cell_index(fields, 0, 0, 1)] = 0.0;  // a layer without a bed does not count as a front at 0
  EXPECT_NEAR(*front_dense_mean(fields, scene), 0.3, 1e-14);
}

TEST(FrontQuantile, CutsTheCellThatHoldsTheQuantile) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(front_quantile(fields, scene));
  fill(fields, fields.f_s, {0, 4}, {0, 5}, 0.5);  // uniform to x = 0.2
  EXPECT_NEAR(*front_quantile(fields, scene), 0.995 * 0.2, 1e-14);
  fill(fields, fields.f_s, {7, 8}, {0, 5}, 0.001);  // a trace at the end holds less than half a per cent
  EXPECT_LT(*front_quantile(fields, scene), 0.2);
}

TEST(Slope, OfAStraightFaceIsItsAngle) {
  const auto scene = make_scene(2, {40, 50, 1}, {0.4, 0.1, 0.05});
  auto fields = empty_fields(scene);
  const double gradient = 0.5;
  for (int i = 0; i < 40; ++i) {
    const double height = std::clamp(0.08 - gradient * ((i + 0.5) * 0.01 - 0.1), 0.0, 0.08);
    for (int j = 0; j < 50; ++j) {
      fields.f_s[cell_index(fields, i, j, 0)] = 0.57 * std::clamp(height / 0.002 - j, 0.0, 1.0);
    }
  }
  EXPECT_NEAR(*deposit_height(fields, scene), 0.08, 1e-14);
  EXPECT_NEAR(*slope(fields, scene), std::atan(gradient) * 180.0 / std::numbers::pi, 1e-10);
}

// Columns of 1, 0.78, 0.76, 0.5, 0.3 and 0.1 of the largest: the line goes through the four from 0.8 to 0.2.
TEST(Slope, IsOfTheFaceFrom80To20PerCent) {
  const auto scene = make_scene(2, {6, 50, 1}, {0.06, 0.1, 0.05});
  auto fields = empty_fields(scene);
  const std::array heights{1.0, 0.78, 0.76, 0.5, 0.3, 0.1};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 50; ++j)
      fields.f_s[cell_index(fields, i, j, 0)] =
          0.57 * std::clamp(0.05 * heights[static_cast<std::size_t>(i)] / 0.002 - j, 0.0, 1.0);
  EXPECT_NEAR(*slope(fields, scene), std::atan(0.17 * 0.05 / 0.01) * 180.0 / std::numbers::pi, 1e-10);
}

TEST(Slope, IsUndefinedForAVerticalFaceAndWithoutABed) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(slope(fields, scene));
  EXPECT_FALSE(deposit_height(fields, scene));
  fill(fields, fields.f_s, {0, 3}, {0, 4}, 0.57);
  EXPECT_FALSE(slope(fields, scene));
  EXPECT_NEAR(*deposit_height(fields, scene), 0.08, 1e-14);
  fill(fields, fields.f_s, {0, 8}, {0, 4}, 0.57);  // the bed fills the tank: no face
  EXPECT_FALSE(slope(fields, scene));
}

TEST(BedHeightProfile, AveragesOverTheWidthIn3D) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.f_s[cell_index(fields, 1, 0, 0)] = 0.57;
  const auto height = bed_height_profile(fields, scene);
  ASSERT_EQ(height.size(), 4U);
  EXPECT_NEAR(height[1], 0.05, 1e-15);
  EXPECT_EQ(height[0], 0.0);
}

}  // namespace
