#include <algorithm>

#include <gtest/gtest.h>

#include "solver/output/extract_bed.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;
using namespace granvof::scalar;

namespace {

constexpr double threshold = 0.95 * 0.57;

TEST(BasePressure, IsTheMeanOfTheLowestRowUnderTheBed) {
  auto scene = small_scene();
  auto fields = empty_fields(scene);
  for (int i = 0; i < 8; ++i) fields.p_c[cell_index(fields, i, 0, 0)] = 100.0 * (i + 1);
  fill(fields, fields.p_c, {0, 8}, {1, 5}, 1e6);
  EXPECT_FALSE(p_base(fields, scene));  // no bed in the scene
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.15, 0.06, 0.1});
  EXPECT_NEAR(*p_base(fields, scene), 200.0, 1e-10);
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.125, 0.06, 0.1});  // half of the third cell
  EXPECT_NEAR(*p_base(fields, scene), (100.0 + 200.0 + 0.5 * 300.0) / 2.5, 1e-10);
}

// Over the whole floor, and over a part of it: each column has its own base.
TEST(BasePressure, IsTakenOnTopOfObstaclesOnTheFloor) {
  auto scene = small_scene();  // cells of 0.05 x 0.02 m
  scene.bed = bed_of({0.0, 0.04, 0.0}, {0.2, 0.08, 0.1});
  auto fields = empty_fields(scene);
  for (int j = 0; j < 5; ++j) fill(fields, fields.p_c, {0, 8}, {j, j + 1}, 100.0 * (j + 1));
  scene.obstacles = {{{0.0, 0.0, 0.0}, {0.4, 0.04, 0.1}}};
  EXPECT_EQ(p_base(fields, scene), 300.0);
  EXPECT_NEAR(*base_height(fields, scene), 0.05, 1e-14);
  scene.obstacles = {{{0.0, 0.0, 0.0}, {0.1, 0.04, 0.1}}, {{0.1, 0.04, 0.0}, {0.2, 0.06, 0.1}}};
  EXPECT_EQ(p_base(fields, scene), 200.0);  // the second is a roof over an open floor
  scene.obstacles = {{{0.0, 0.0, 0.0}, {0.2, 0.1, 0.1}}};
  EXPECT_FALSE(p_base(fields, scene));
}

TEST(BasePressure, In3DCountsOnlyTheBedsShareOfTheWidth) {
  auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.p_c[cell_index(fields, 0, 0, 0)] = 10.0;
  fields.p_c[cell_index(fields, 0, 0, 1)] = 50.0;
  scene.bed = bed_of({0.0, 0.0, 0.1}, {0.1, 0.1, 0.2});
  EXPECT_NEAR(*p_base(fields, scene), 50.0, 1e-12);
}

TEST(CentreOfTheDenseBed, WeighsByTheSolidFractionAndSkipsDiluteCells) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_FALSE(y_c(fields, scene));
  fill(fields, fields.f_s, {0, 4}, {0, 5}, 0.5);  // not compacted yet: undefined, not 0
  EXPECT_FALSE(y_c(fields, scene));
  EXPECT_NEAR(*y_solid_mean(fields, scene), 0.05, 1e-14);
  fields.f_s[cell_index(fields, 0, 0, 0)] = 0.60;  // y = 0.01
  fields.f_s[cell_index(fields, 0, 2, 0)] = 0.56;  // y = 0.05
  EXPECT_NEAR(*y_c(fields, scene), (0.60 * 0.01 + 0.56 * 0.05) / 1.16, 1e-14);
}

TEST(CentreOfTheDenseBed, TakesNoCellAtTheThreshold) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 1}, {0, 1}, threshold);
  EXPECT_FALSE(y_c(fields, scene));
}

// Fills the rows of the bed's columns with what a sharp bed from `bottom` to `top` [m] leaves in each.
void fill_sharp(CellFields& fields, double bottom, double top, double packing, double around = 0.0) {
  const double h = fields.spacing[1];
  for (int j = 0; j < fields.cells[1]; ++j) {
    const double share = std::clamp(std::min(top, (j + 1) * h) - std::max(bottom, j * h), 0.0, h) / h;
    fill(fields, fields.f_s, {0, fields.cells[0]}, {j, j + 1}, around + share * (packing - around));
  }
}

TEST(BedEdges, AreWhereASharpBedEndsWhereverItCutsACell) {
  auto scene = small_scene();  // five rows of 0.02 m
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.1, 0.1});
  auto fields = empty_fields(scene);
  for (const double packing : {threshold + 1e-9, 0.57, 0.61})
    for (const double top : {0.06, 0.0605, 0.066, 0.07, 0.075, 0.0788, 0.0795}) {
      fill_sharp(fields, 0.0, top, packing);
      EXPECT_NEAR(*bed_top(fields, scene), top, 1e-12) << packing;
      EXPECT_EQ(*bed_bottom(fields, scene), 0.0);
      fill_sharp(fields, 0.1 - top, 0.1, packing);  // turned over, as under a lid
      EXPECT_NEAR(*bed_bottom(fields, scene), 0.1 - top, 1e-12) << packing;
      EXPECT_DOUBLE_EQ(*bed_top(fields, scene), 0.1);
      if (top > 0.077) continue;  // in the row below the ceiling nothing tells a suspension from a bed
      fill_sharp(fields, 0.0, top, 0.6, 0.2);
      EXPECT_NEAR(*bed_top(fields, scene), top, 1e-12) << packing;
    }
}

TEST(BedEdges, MoveWithoutAJumpAsARowFills) {
  auto scene = small_scene();
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.1, 0.1});
  auto fields = empty_fields(scene);
  double last = 0.04;
  for (double top = 0.0401; top < 0.0799; top += 1e-4) {
    fill_sharp(fields, 0.0, top, 0.57);
    EXPECT_NEAR(*bed_top(fields, scene) - last, 1e-4, 1e-9) << top;
    last = *bed_top(fields, scene);
  }
}

TEST(BedEdges, AreThoseOfTheProfileOverTheOriginalColumns) {
  auto scene = small_scene();
  scene.bed = bed_of({0.1, 0.02, 0.0}, {0.3, 0.08, 0.1});
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {2, 6}, {2, 4}, 0.6);
  EXPECT_NEAR(*bed_bottom(fields, scene), 0.04, 1e-14);
  EXPECT_NEAR(*bed_top(fields, scene), 0.08, 1e-14);
  EXPECT_NEAR(*bed_height(fields, scene), 0.04, 1e-14);
  fill(fields, fields.f_s, {0, 2}, {0, 5}, 0.6);  // grains beside the original columns do not count
  EXPECT_NEAR(*bed_height(fields, scene), 0.04, 1e-14);
}

TEST(BedEdges, ABedThatFillsTheTankReachesFloorAndCeiling) {
  auto scene = small_scene();
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.1, 0.1});
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 8}, {0, 5}, 0.6);
  EXPECT_EQ(*bed_bottom(fields, scene), 0.0);
  EXPECT_DOUBLE_EQ(*bed_top(fields, scene), 0.1);
  EXPECT_NEAR(*bed_height_equivalent(fields, scene), 0.1, 1e-14);
}

TEST(BedEdges, AreUndefinedWithoutADenseProfileOrABed) {
  auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 8}, {0, 5}, 0.6);
  EXPECT_FALSE(bed_height(fields, scene));  // the scene has no bed
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.1, 0.1});
  fill(fields, fields.f_s, {0, 4}, {0, 5}, 0.0);  // half of the columns: dense cells, but a dilute profile
  EXPECT_FALSE(bed_bottom(fields, scene));
  EXPECT_FALSE(bed_top(fields, scene));
  EXPECT_FALSE(bed_height(fields, scene));
  EXPECT_FALSE(bed_height_equivalent(fields, scene));
}

TEST(BedEdges, EquivalentHeightCountsPartlyFilledRows) {
  auto scene = small_scene();
  scene.bed = bed_of({0.0, 0.0, 0.0}, {0.4, 0.1, 0.1});
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 8}, {1, 4}, 0.6);
  fill(fields, fields.f_s, {0, 8}, {4, 5}, 0.15);  // a quarter of a row
  EXPECT_NEAR(*bed_height_equivalent(fields, scene), 3.25 * 0.02, 1e-14);
}

TEST(SolidVolume, StandsForTheTanksDepthIn2D) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  EXPECT_EQ(*solid_volume(fields, scene), 0.0);
  EXPECT_FALSE(y_solid_mean(fields, scene));
  fill(fields, fields.f_s, {0, 2}, {0, 3}, 0.5);
  EXPECT_NEAR(*solid_volume(fields, scene), 0.5 * 0.1 * 0.06 * 0.1, 1e-17);

  // A slice of two layers, thinner than the tank, as the reference computes it: the same volume.
  auto slice_scene = scene;
  slice_scene.grid.cells = {8, 5, 2};
  slice_scene.grid.spacing[2] = 0.001;
  auto slice = empty_fields(slice_scene);
  fill(slice, slice.f_s, {0, 2}, {0, 3}, 0.5);
  EXPECT_NEAR(*solid_volume(slice, slice_scene), 0.5 * 0.1 * 0.06 * 0.1, 1e-17);
}

TEST(SolidVolume, Of3DCells) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.f_s[cell_index(fields, 3, 2, 1)] = 0.5;
  EXPECT_NEAR(*solid_volume(fields, scene), 0.5e-3, 1e-17);
  EXPECT_NEAR(*y_solid_mean(fields, scene), 0.25, 1e-14);
}

TEST(SolidExtremes, AreThoseOfAnyCell) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fields.f_s[3] = 0.62;
  fields.f_s[4] = -1e-9;
  EXPECT_EQ(*f_s_max(fields, scene), 0.62);
  EXPECT_EQ(*f_s_min(fields, scene), -1e-9);
}

TEST(LargestTemperature, LeavesOutCellsWithoutGrains) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fields.theta[0] = 5.0;
  EXPECT_FALSE(theta_max(fields, scene));
  fields.f_s[1] = 0.1;
  fields.f_s[2] = 0.05;
  fields.theta[2] = 3.0;
  fields.theta[1] = 2.0;
  EXPECT_EQ(*theta_max(fields, scene), 2.0);
}

}  // namespace
