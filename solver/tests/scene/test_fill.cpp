// Shares of cells against areas known by hand, and sums over a grid against the whole.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solver/scene/fill.hpp"

namespace granvof::test {
namespace {

double volume(const Bed& bed, double dx, double dy, int nx, int ny) {
  double sum = 0.0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i)
      sum += share_of(bed, {{i * dx, j * dy, 0}, {(i + 1) * dx, (j + 1) * dy, 1}}) * dx * dy;
  }
  return sum;
}

TEST(Fill, BoxSharesArePartial) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_DOUBLE_EQ(share_of(box, {{0.5, 0.75, 0}, {1.5, 1.75, 1}}), 0.125);
  EXPECT_EQ(share_of(box, {{2, 0, 0}, {3, 1, 1}}), 0.0);
}

TEST(Fill, TheUnionCountsACommonPartOnce) {
  const std::vector<Box> boxes{
      {{0, 0, 0}, {0.6, 1, 1}}, {{0.4, 0, 0}, {1, 0.5, 1}}, {{0.4, 0.5, 0}, {0.5, 1, 1}}};
  EXPECT_DOUBLE_EQ(share_of(boxes, {{0, 0, 0}, {1, 1, 1}}), 0.8);
}

TEST(Fill, WhatBedAndLiquidShareCountsOnce) {
  const Box cell{{0, 0, 0}, {1, 1, 1}};
  const Bed bed{{{0, 0, 0}, {1, 0.5, 1}}, 0.5, 90.0}, heap{{{0, 0, 0}, {2, 1, 1}}, 0.5, 45.0};
  const std::vector<Box> boxes{{{0, 0.25, 0}, {1, 0.75, 1}}, {{0.5, 0, 0}, {1, 0.5, 1}}};
  EXPECT_DOUBLE_EQ(shared_by(bed, boxes, cell), 0.375);
  EXPECT_DOUBLE_EQ(shared_by(heap, boxes, {{1, 0, 0}, {2, 1, 1}}), 0.0);
  EXPECT_DOUBLE_EQ(shared_by(heap, {boxes.data(), 1}, cell), 0.5);
  EXPECT_DOUBLE_EQ(shared_by(bed, {}, cell), 0.0);
}

TEST(Fill, ASlopedFaceCutsCells) {
  const Bed bed{{{0, 0, 0}, {2, 1, 1}}, 0.5, 45.0};  // top face to x = 1, then down to (2, 0)
  EXPECT_DOUBLE_EQ(share_of(bed, {{0, 0, 0}, {1, 1, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(share_of(bed, {{1, 0, 0}, {2, 1, 1}}), 0.5);
  EXPECT_DOUBLE_EQ(share_of(bed, {{1, 0, 0}, {1.5, 0.5, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(share_of(bed, {{1.5, 0.5, 0}, {2, 1, 1}}), 0.0);
  EXPECT_DOUBLE_EQ(share_of(bed, {{1.5, 0, 0}, {2.5, 1, 1}}), 0.125);
  EXPECT_DOUBLE_EQ(share_of(bed, {{1, 0.75, 0}, {2, 1.25, 1}}), 0.0625);
}

TEST(Fill, CellsAddUpToTheBed) {
  const Bed heap{{{0.003, 0.004, 0}, {0.273, 0.044, 1}}, 0.57, 12.0};
  const double expected = 0.27 * 0.04 - 0.5 * 0.04 * 0.04 / std::tan(12.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(volume(heap, 0.0025, 0.0025, 160, 48), expected, 1e-15);
  const Bed box{{{0.003, 0.004, 0}, {0.273, 0.044, 1}}, 0.57, 90.0};
  EXPECT_NEAR(volume(box, 0.0025, 0.0025, 160, 48), 0.27 * 0.04, 1e-15);
}

TEST(Fill, AnAlmostVerticalFaceIsABox) {
  const Bed box{{{0, 0, 0}, {1, 1, 1}}, 0.5, 90.0};
  const Bed steep{{{0, 0, 0}, {1, 1, 1}}, 0.5, 89.9999};
  EXPECT_NEAR(volume(box, 0.1, 0.1, 12, 12), volume(steep, 0.1, 0.1, 12, 12), 1e-5);
}

TEST(Fill, ColoursOfBandsArePartial) {
  Bed bed{{{1, 2, 0}, {5, 6, 1}}, 0.5, 90.0};
  EXPECT_EQ(colour_of(bed, {{2, 3, 0}, {3, 4, 1}}), 1.0);
  bed.colour_size = 0.5;
  bed.colour = ColourPattern::layers;  // 1 in [2, 2.5], 0 in [2.5, 3], ...
  EXPECT_DOUBLE_EQ(colour_of(bed, {{2, 2, 0}, {3, 2.5, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{2, 2.5, 0}, {3, 3, 1}}), 0.0);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{2, 2.25, 0}, {3, 3.25, 1}}), 0.5);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{2, 1, 0}, {3, 2.75, 1}}), 2.0 / 3.0);  // the bed's part of the cell alone
  EXPECT_EQ(colour_of(bed, {{6, 2, 0}, {7, 3, 1}}), 0.0);
  bed.colour = ColourPattern::columns;  // 1 in [1, 1.5], ...
  EXPECT_DOUBLE_EQ(colour_of(bed, {{1, 2, 0}, {1.5, 6, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{1.25, 2, 0}, {1.75, 6, 1}}), 0.5);
  bed.colour = ColourPattern::checks;
  EXPECT_DOUBLE_EQ(colour_of(bed, {{1, 2, 0}, {1.5, 2.5, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{1.5, 2, 0}, {2, 2.5, 1}}), 0.0);
  EXPECT_DOUBLE_EQ(colour_of(bed, {{1.5, 2.5, 0}, {2, 3, 1}}), 1.0);
}

}  // namespace
}  // namespace granvof::test
