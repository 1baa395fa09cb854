#include "reference/demvof/preparation/rough_floor.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace demvof {

namespace {

constexpr double coverage = 0.50;      // share of the area [-]
constexpr double highest_centre = 0.2;  // in diameters

// Discs in plan, found again by a grid of squares so small that each holds at most one.
class Plan {
 public:
  Plan(const FloorArea& area, double diameter)
      : area_(area),
        diameter_(diameter),
        columns_(static_cast<int>(area.length / (diameter / std::numbers::sqrt2)) + 1),
        rows_(static_cast<int>(area.depth / (diameter / std::numbers::sqrt2)) + 1),
        holds_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {}

  bool fits(double x, double z) const {
    const int column = column_of(x), row = row_of(z);
    for (int dr = -2; dr <= 2; ++dr) {
      for (int dc = -2; dc <= 2; ++dc) {
        const int c = column + dc;
        int r = row + dr;
        if (c < 0 || c >= columns_) continue;
        if (r < 0 || r >= rows_) {
          if (!area_.periodic_depth) continue;
          r = (r + rows_) % rows_;
        }
        const int other = holds_[slot(c, r)];
        if (other >= 0 && near(x, z, other)) return false;
      }
    }
    // The last row of squares is cut by the periodic end: look once more past it.
    return !area_.periodic_depth || !near_across(x, z);
  }

  void place(double x, double z) {
    holds_[slot(column_of(x), row_of(z))] = static_cast<int>(x_.size());
    x_.push_back(x);
    z_.push_back(z);
  }

 private:
  int column_of(double x) const { return static_cast<int>(x / (diameter_ / std::numbers::sqrt2)); }
  int row_of(double z) const { return static_cast<int>(z / (diameter_ / std::numbers::sqrt2)); }
  std::size_t slot(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }
  bool near(double x, double z, int other) const {
    const double dx = x - x_[static_cast<std::size_t>(other)];
    double dz = z - z_[static_cast<std::size_t>(other)];
    if (area_.periodic_depth) dz -= area_.depth * std::round(dz / area_.depth);
    return dx * dx + dz * dz < diameter_ * diameter_;
  }
  bool near_across(double x, double z) const {
    if (z > diameter_ && z < area_.depth - diameter_) return false;
    const int column = column_of(x);
    for (int c = std::max(0, column - 2); c <= std::min(columns_ - 1, column + 2); ++c) {
      for (int r = 0; r < rows_; ++r) {
        if (r > 2 && r < rows_ - 3) continue;
        const int other = holds_[slot(c, r)];
        if (other >= 0 && near(x, z, other)) return true;
      }
    }
    return false;
  }

  FloorArea area_;
  double diameter_;
  int columns_, rows_;
  std::vector<int> holds_;
  std::vector<double> x_, z_;
};

}  // namespace

std::vector<double> rough_floor(const FloorArea& area, double diameter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Plan plan(area, diameter);
  const double bead_area = std::numbers::pi / 4.0 * diameter * diameter;
  const auto wanted = static_cast<std::size_t>(coverage * area.length * area.depth / bead_area);
  std::vector<double> positions;
  // Random placing reaches half coverage long before it jams; the limit only guards against a wrong area.
  for (std::size_t tries = 0; positions.size() < 3 * wanted && tries < 2000 * wanted; ++tries) {
    const double x = share(random) * area.length, z = share(random) * area.depth;
    if (!plan.fits(x, z)) continue;
    plan.place(x, z);
    positions.insert(positions.end(), {x, highest_centre * diameter * share(random), z});
  }
  return positions;
}

}  // namespace demvof
