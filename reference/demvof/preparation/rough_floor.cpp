#include "reference/demvof/preparation/rough_floor.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "reference/demvof/preparation/disperse.hpp"

namespace demvof {

namespace {

constexpr double coverage = 0.70;  // share of the area [-]; gaps are too small for a bead to reach the plane
constexpr double highest_centre = 0.2;  // in diameters

}  // namespace

std::vector<double> rough_floor(const FloorArea& area, double diameter, unsigned seed) {
  std::mt19937 random(seed);
  const double bead_area = std::numbers::pi / 4.0 * diameter * diameter;
  const auto count = static_cast<std::size_t>(coverage * area.length * area.depth / bead_area);
  // A box one bead high holds them all at one height: discs in plan.
  std::vector<double> positions = disperse_beads(count, {0.0, 0.0, 0.0}, {area.length, diameter, area.depth},
                                                 area.periodic_depth, diameter, random);
  std::uniform_real_distribution<double> height(0.0, highest_centre * diameter);
  for (std::size_t n = 1; n < positions.size(); n += 3) positions[n] = height(random);
  return positions;
}

}  // namespace demvof
