// Frozen beads that make a floor rough.
#pragma once

#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

struct FloorArea {
  double length = 0.0;          // along x from 0 [m]
  double depth = 0.0;           // along z from 0 [m]
  bool periodic_depth = true;
};

// Beads placed at random without overlap in plan, half sunk: centres at heights 0 to 0.2 d over the floor plane.
// They cover about half of the area (random placing jams at 0.547). Three numbers a bead; the same seed gives the
// same floor.
std::vector<double> rough_floor(const FloorArea& area, double diameter, unsigned seed);

}  // namespace demvof
