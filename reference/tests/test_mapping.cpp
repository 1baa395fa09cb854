#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "reference/demvof/coupling/mapping.hpp"

using demvof::Mapping;

namespace {

std::vector<double> random_positions(std::size_t count, const demvof::Vector& size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<double> x;
  for (std::size_t n = 0; n < 3 * count; ++n) x.push_back(size[n % 3] * share(random));
  return x;
}

double total(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

}  // namespace

TEST(Mapping, DepositKeepsTheTotalUpToTheWalls) {
  for (const std::array<int, 3> cells : {std::array<int, 3>{8, 5, 1}, std::array<int, 3>{8, 5, 4}}) {
    Mapping mapping(cells, {0.1, 0.2, 0.3});
    mapping.update(random_positions(500, {0.8, 1.0, 0.3 * cells[2]}));
    std::vector<double> grid(mapping.cell_count(), 0.0);
    mapping.deposit(2.0, grid);
    EXPECT_NEAR(total(grid), 1000.0, 1e-9);
  }
}

TEST(Mapping, GatherIsTheTransposeOfDeposit) {
  Mapping mapping({8, 5, 1}, {0.1, 0.2, 0.3});
  mapping.update(random_positions(200, {0.8, 1.0, 0.3}));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> cells(mapping.cell_count()), beads(200), gathered(200),
      deposited(mapping.cell_count(), 0.0);
  for (double& v : cells) v = normal(random);
  for (double& v : beads) v = normal(random);
  mapping.gather(cells, 1, 0, gathered);
  mapping.deposit(beads, 1, 0, deposited);
  const double left = std::inner_product(beads.begin(), beads.end(), gathered.begin(), 0.0);
  const double right = std::inner_product(cells.begin(), cells.end(), deposited.begin(), 0.0);
  EXPECT_NEAR(left, right, 1e-12);
}

TEST(Mapping, GatherIsExactForALinearField) {
  Mapping mapping({8, 6, 1}, {0.1, 0.1, 0.3});
  const std::vector<double> position{0.33, 0.27, 0.1, 0.41, 0.5, 0.2};
  mapping.update(position);
  std::vector<double> cells, gathered(2);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 8; ++i) cells.push_back(3.0 * (i + 0.5) * 0.1 - 2.0 * (j + 0.5) * 0.1);
  mapping.gather(cells, 1, 0, gathered);
  EXPECT_NEAR(gathered[0], 3.0 * 0.33 - 2.0 * 0.27, 1e-12);
  EXPECT_NEAR(gathered[1], 3.0 * 0.41 - 2.0 * 0.5, 1e-12);
}

TEST(Mapping, AClosedGateKeepsABeadOnItsSide) {
  Mapping mapping({8, 2, 1}, {0.1, 0.1, 0.3});
  mapping.set_gate(4, {1.0, 0.0});
  // Just left of the gate at x = 0.4: in the lower row, closed, and in the upper row, open.
  mapping.update({0.39, 0.05, 0.1, 0.39, 0.15, 0.1});
  std::vector<double> lower(mapping.cell_count(), 0.0), upper(lower);
  mapping.deposit({1.0, 0.0}, 1, 0, lower);
  mapping.deposit({0.0, 1.0}, 1, 0, upper);
  EXPECT_NEAR(lower[3], 1.0, 1e-12);
  EXPECT_NEAR(lower[4], 0.0, 1e-12);
  EXPECT_NEAR(upper[8 + 3], 0.6, 1e-12);
  EXPECT_NEAR(upper[8 + 4], 0.4, 1e-12);
}

// A gate that lifts must not move beads from cell to cell in one jump: half open, half of the share passes.
TEST(Mapping, AHalfOpenGatePassesHalfOfTheShare) {
  Mapping mapping({8, 2, 1}, {0.1, 0.1, 0.3});
  mapping.set_gate(4, {0.5, 0.0});
  mapping.update({0.39, 0.05, 0.1, 0.41, 0.05, 0.1});
  std::vector<double> left(mapping.cell_count(), 0.0), right(left);
  mapping.deposit({1.0, 0.0}, 1, 0, left);
  mapping.deposit({0.0, 1.0}, 1, 0, right);
  EXPECT_NEAR(left[4], 0.2, 1e-12);
  EXPECT_NEAR(left[3], 0.8, 1e-12);
  EXPECT_NEAR(right[3], 0.2, 1e-12);
  EXPECT_NEAR(right[4], 0.8, 1e-12);
}
