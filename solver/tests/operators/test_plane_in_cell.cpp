// Planes that cut a cell: known volumes, the inverse, and slabs that add up to the whole.
#include <random>

#include <gtest/gtest.h>

#include "solver/operators/plane_in_cell.hpp"

namespace granvof {
namespace {

using Normal = std::array<double, 3>;

TEST(PlaneInCell, KnownVolumes) {
  EXPECT_DOUBLE_EQ(volume_below({1.0, 0.0, 0.0}, 0.3), 0.3);
  EXPECT_DOUBLE_EQ(volume_below({0.5, 0.5, 0.0}, 0.25), 0.125);  // triangle with sides of one half
  EXPECT_DOUBLE_EQ(volume_below({0.5, 0.5, 0.0}, 0.75), 0.875);
  const double third = 1.0 / 3.0;
  EXPECT_NEAR(volume_below({third, third, third}, third), 1.0 / 6.0, 1e-15);  // corner tetrahedron
  EXPECT_NEAR(volume_below({third, third, third}, 0.5), 0.5, 1e-15);
  EXPECT_NEAR(volume_below({2.0, 2.0, 2.0}, 1.0), 1.0 / 48.0, 1e-15);  // the normal's length does not matter
  EXPECT_EQ(volume_below({0.2, 0.3, 0.5}, -0.1), 0.0);
  EXPECT_EQ(volume_below({0.2, 0.3, 0.5}, 1.1), 1.0);
}

// Counts points of a fine lattice: independent of the formula.
TEST(PlaneInCell, AgreesWithCountedPoints) {
  constexpr int points = 60;
  for (const Normal& m : {Normal{0.1, 0.2, 0.7}, Normal{0.3, 0.3, 0.4}, Normal{0.05, 0.45, 0.5}}) {
    for (double d : {0.03, 0.12, 0.22, 0.35, 0.48, 0.66, 0.9}) {
      int below = 0;
      for (int k = 0; k < points; ++k)
        for (int j = 0; j < points; ++j)
          for (int i = 0; i < points; ++i)
            below += (m[0] * (i + 0.5) + m[1] * (j + 0.5) + m[2] * (k + 0.5)) / points <= d ? 1 : 0;
      EXPECT_NEAR(volume_below(m, d), below / std::pow(points, 3), 5e-3);
    }
  }
}

TEST(PlaneInCell, DistanceUndoesVolume) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 20000; ++trial) {
    Normal m{uniform(random), uniform(random), trial % 3 == 0 ? 0.0 : uniform(random)};
    if (trial % 5 == 0) m[0] *= 1e-5;
    const double sum = m[0] + m[1] + m[2];
    for (double& component : m) component /= sum;
    const double volume = trial % 7 == 0 ? 1e-9 * uniform(random) : uniform(random);
    const double distance = distance_of_volume(m, volume);
    ASSERT_GE(distance, 0.0);
    ASSERT_LE(distance, 1.0);
    ASSERT_NEAR(volume_below(m, distance), volume, 1e-11) << m[0] << ' ' << m[1] << ' ' << m[2];
  }
  EXPECT_EQ(distance_of_volume({0.2, 0.3, 0.5}, 0.0), 0.0);
  EXPECT_EQ(distance_of_volume({0.2, 0.3, 0.5}, 1.0), 1.0);
}

TEST(PlaneInCell, SlabsAddUp) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 5000; ++trial) {
    Normal m{uniform(random), uniform(random), trial % 2 == 0 ? 0.0 : uniform(random)};
    const double sum = m[0] + m[1] + m[2];
    for (double& component : m) component /= sum;
    const double volume = uniform(random), cut = uniform(random);
    const PlaneInCell plane{m, distance_of_volume(m, volume)};
    for (int i = 0; i < 3; ++i) {
      const double low = volume_in_slab(plane, i, 0.0, cut), high = volume_in_slab(plane, i, cut, 1.0);
      ASSERT_LE(low, cut + 1e-15);
      ASSERT_NEAR(low + high, volume, 1e-10);
    }
  }
}

}  // namespace
}  // namespace granvof
