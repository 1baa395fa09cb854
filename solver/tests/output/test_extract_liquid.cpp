#include <gtest/gtest.h>

#include "solver/output/extract_liquid.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;
using namespace granvof::scalar;

namespace {

TEST(InterfaceHeight, OfALevelOnAFaceIsTheFace) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 8}, {0, 3}, 1.0);
  EXPECT_NEAR(*interface_height(fields, scene), 0.06, 1e-14);
  EXPECT_NEAR(*liquid_height_left(fields, scene), 0.06, 1e-14);
}

TEST(InterfaceHeight, InACellIsInterpolated) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 8}, {0, 3}, 1.0);
  fill(fields, fields.alpha, {0, 8}, {3, 4}, 0.3);
  EXPECT_NEAR(*interface_height(fields, scene), 0.05 + 0.02 * 0.5 / 0.7, 1e-14);
}

TEST(InterfaceHeight, DoesNotSeeTheGrains) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 8}, {0, 3}, 1.0);
  fill(fields, fields.f_s, {0, 8}, {1, 5}, 0.6);
  EXPECT_NEAR(*interface_height(fields, scene), 0.06, 1e-14);
}

TEST(InterfaceHeight, WeighsARowByItsFluid) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 8}, {0, 2}, 1.0);
  fill(fields, fields.alpha, {0, 4}, {2, 3}, 1.0);  // half of the row by area,
  fill(fields, fields.f_s, {0, 4}, {2, 3}, 0.6);    // but 0.4 / 1.4 of its fluid
  const double share = 0.4 / 1.4;
  EXPECT_NEAR(*interface_height(fields, scene), 0.03 + 0.02 * 0.5 / (1.0 - share), 1e-14);
}

TEST(InterfaceHeight, EmptyAndFullTank) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(interface_height(fields, scene));
  fill(fields, fields.alpha, {0, 8}, {0, 5}, 1.0);
  EXPECT_DOUBLE_EQ(*interface_height(fields, scene), 0.1);
}

TEST(InterfaceHeightOutside, LeavesOutTheBedsColumns) {
  auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 4}, {0, 3}, 1.0);
  fill(fields, fields.alpha, {4, 8}, {0, 2}, 1.0);
  EXPECT_FALSE(interface_height_outside(fields, scene));  // no bed
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.2, 0.06, 0.1});
  EXPECT_NEAR(*interface_height_outside(fields, scene), 0.04, 1e-14);
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.06, 0.1});  // a bed across the whole tank
  EXPECT_FALSE(interface_height_outside(fields, scene));
}

TEST(LiquidFront, IsTheFarthestWetPointOfTheFloor) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(liquid_front(fields, scene));
  fill(fields, fields.alpha, {0, 3}, {0, 1}, 1.0);
  fill(fields, fields.alpha, {0, 6}, {1, 5}, 1.0);  // what hangs above the floor does not count
  EXPECT_NEAR(*liquid_front(fields, scene), 0.15, 1e-14);
  fill(fields, fields.alpha, {0, 8}, {0, 1}, 1.0);
  EXPECT_DOUBLE_EQ(*liquid_front(fields, scene), 0.4);
}

TEST(LiquidFront, In3DIsTheLargestOverTheWidth) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.alpha[cell_index(fields, 0, 0, 0)] = 1.0;
  for (int i = 0; i < 3; ++i) fields.alpha[cell_index(fields, i, 0, 1)] = 1.0;
  EXPECT_NEAR(*liquid_front(fields, scene), 0.3, 1e-14);
}

TEST(LiquidHeightAtTheWalls, AreThoseOfTheEndColumns) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.alpha, {0, 1}, {0, 2}, 1.0);
  fill(fields, fields.alpha, {0, 1}, {2, 3}, 0.25);
  fill(fields, fields.alpha, {7, 8}, {0, 4}, 1.0);
  EXPECT_NEAR(*liquid_height_left(fields, scene), 0.045, 1e-14);
  EXPECT_NEAR(*liquid_height_right(fields, scene), 0.08, 1e-14);
}

TEST(LiquidHeightAtTheWalls, AreMeansOverTheWidthIn3D) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.alpha[cell_index(fields, 0, 0, 1)] = 1.0;
  EXPECT_NEAR(*liquid_height_left(fields, scene), 0.05, 1e-14);
}

TEST(LiquidVolume, LeavesOutTheGrains) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_EQ(*liquid_volume(fields, scene), 0.0);
  fill(fields, fields.alpha, {0, 8}, {0, 5}, 1.0);
  fill(fields, fields.f_s, {0, 4}, {0, 5}, 0.5);
  EXPECT_NEAR(*liquid_volume(fields, scene), 0.75 * 0.4 * 0.1 * 0.1, 1e-16);
}

}  // namespace
