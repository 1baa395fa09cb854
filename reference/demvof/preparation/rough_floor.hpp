// Frozen beads that make a floor rough.
#pragma once

#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

struct FloorArea {
  double length = 0.0;  // along x from 0 [m]
  double depth = 0.0;   // along z from 0 [m]
  bool periodic_depth = true;
};

// Beads at random without overlap in plan (less than 1 % of d), half sunk: centres at heights 0 to 0.2 d over
// the floor plane. They cover 70 % of the area, so that no other bead reaches the plane. Three numbers a
// bead; the same seed gives the same floor.
std::vector<double> rough_floor(const FloorArea& area, double diameter, unsigned seed);

}  // namespace demvof
