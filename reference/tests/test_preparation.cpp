#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "reference/demvof/beads/bead_engine.hpp"
#include "reference/demvof/preparation/column.hpp"
#include "reference/demvof/preparation/disperse.hpp"
#include "reference/demvof/preparation/rough_floor.hpp"

namespace {

constexpr double d = 1e-3;

double deepest_overlap(const std::vector<double>& x, double depth, bool in_plan) {
  double deepest = 0.0;
  for (std::size_t a = 0; a + 2 < x.size(); a += 3) {
    for (std::size_t b = a + 3; b + 2 < x.size(); b += 3) {
      double dz = x[a + 2] - x[b + 2];
      dz -= depth * std::round(dz / depth);
      const double dy = in_plan ? 0.0 : x[a + 1] - x[b + 1];
      deepest = std::max(deepest, d - std::hypot(x[a] - x[b], dy, dz));
    }
  }
  return deepest;
}

demvof::ColumnSettings small_column() {
  demvof::ColumnSettings s;
  s.upper = {0.012, 0.012, 0.004};
  s.diameter = d;
  s.density = 2500.0;
  s.buoyant_gravity = 5.9;
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  return s;
}

}  // namespace

// LIGGGHTS says of each style of a second engine that it is there already.
TEST(Engine, TheSecondOneSaysNothing) {
  demvof::BeadSettings settings;
  settings.diameter = d;
  settings.density = 2500.0;
  settings.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  settings.upper = {0.01, 0.01, 0.01};
  demvof::BeadState one;
  one.position = {0.005, 0.005, 0.005};
  ::testing::internal::CaptureStderr();
  { const demvof::BeadEngine first(settings, one, {}); }
  { const demvof::BeadEngine second(settings, one, {}); }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Disperse, FillsHalfOfTheBoxWithoutOverlap) {
  std::mt19937 random(1);
  const auto count =
      static_cast<std::size_t>(0.5 * 0.02 * 0.01 * 0.004 / (std::numbers::pi / 6.0 * d * d * d));
  const auto x = demvof::disperse_beads(count, {0, 0, 0}, {0.02, 0.01, 0.004}, true, d, random);
  EXPECT_EQ(x.size(), 3 * count);
  EXPECT_LT(deepest_overlap(x, 0.004, false), 0.01 * d);
}

TEST(RoughFloor, CoversSeventyPercentWithoutOverlapInPlan) {
  const auto x = demvof::rough_floor({0.05, 0.004, true}, d, 5);
  const std::size_t count = x.size() / 3;
  const double covered = static_cast<double>(count) * std::numbers::pi / 4.0 * d * d / (0.05 * 0.004);
  EXPECT_NEAR(covered, 0.7, 0.01);
  EXPECT_LT(deepest_overlap(x, 0.004, true), 0.01 * d);
  for (std::size_t n = 1; n < x.size(); n += 3) {
    EXPECT_GE(x[n], 0.0);
    EXPECT_LE(x[n], 0.2 * d);
  }
}

TEST(Column, FrictionOfThePreparationSetsThePacking) {
  demvof::ColumnSettings s = small_column();
  s.preparation_law.bead_friction = s.final_law.bead_friction = 0.05;
  const demvof::Column smooth = demvof::prepare_column(s);
  s.preparation_law.bead_friction = s.final_law.bead_friction = 1.0;
  const demvof::Column rough = demvof::prepare_column(s);
  EXPECT_GT(smooth.packing, rough.packing + 0.015);
  EXPECT_NEAR(smooth.packing, 0.60, 0.04);
  EXPECT_NEAR(rough.packing, 0.56, 0.04);
}

// Friction that the run will not have leaves a looser column, if it is released as prepared.
TEST(Column, ReleasedAsPreparedItIsLooserThanAtRestUnderTheFrictionOfTheRun) {
  demvof::ColumnSettings s = small_column();
  s.preparation_law.bead_friction = 1.0;
  s.preparation_law.rolling_friction = 0.2;
  s.final_law.bead_friction = 0.1;
  const demvof::Column rested = demvof::prepare_column(s);
  s.final_settling = false;
  EXPECT_LT(demvof::prepare_column(s).packing, rested.packing - 0.015);
}

// No bead may start inside another, nor inside a frozen one of the floor, also where floor beads beyond the
// column's front reach under it: what overlaps shoots out as the run begins.
TEST(Column, OverlapsNeitherItselfNorTheFloor) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    demvof::ColumnSettings s = small_column();
    s.preparation_law.rolling_friction = 0.2;
    s.floor = demvof::rough_floor({0.03, 0.004, true}, d, seed);
    s.seed = seed;
    s.final_settling = false;
    const demvof::Column column = demvof::prepare_column(s);
    EXPECT_LT(deepest_overlap(column.position, 0.004, false), 0.05 * d);
    double deepest = 0.0;
    std::array<double, 3> at{};
    for (std::size_t f = 0; f < s.floor.size(); f += 3) {
      for (std::size_t b = 0; b < column.position.size(); b += 3) {
        double dz = column.position[b + 2] - s.floor[f + 2];
        dz -= 0.004 * std::round(dz / 0.004);
        const double overlap =
            d - std::hypot(column.position[b] - s.floor[f], column.position[b + 1] - s.floor[f + 1], dz);
        if (overlap > deepest) at = {s.floor[f], s.floor[f + 1], s.floor[f + 2]};
        deepest = std::max(deepest, overlap);
      }
    }
    EXPECT_LT(deepest, 0.05 * d) << "seed " << seed << ", floor bead at " << at[0] << " " << at[1] << " "
                                 << at[2];
  }
}

TEST(Column, TheSameSeedGivesTheSameColumn) {
  demvof::ColumnSettings s = small_column();
  s.suspended = true;
  s.packing = 0.5;
  EXPECT_EQ(demvof::prepare_column(s).position, demvof::prepare_column(s).position);
  const auto first = demvof::prepare_column(s).position;
  s.seed = 2;
  EXPECT_NE(first, demvof::prepare_column(s).position);
}
