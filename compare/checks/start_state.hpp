// The first row of a series against the scene itself: a box of grains and a level of liquid are known before
// anything moves.
#pragma once

#include <optional>
#include <string>

#include "compare/input/run.hpp"

namespace granvof::compare {

struct StartDistance {
  double largest = 0.0;  // [-]
  std::string column;    // where
};

// Largest distance of a column of the first row from what the scene says it is, over the latter: fronts and
// edges as docs/output.md defines them, volumes, centres, potential energies, and the fluid's pressure at
// rest. Of a bed that is a box, on faces of cells and clear of the far wall, and one level of liquid on a
// face, without obstacles; nothing for others. The pressure is looked at in a level tank that is open at the
// top.
std::optional<StartDistance> start_distance(const Run& run);

}  // namespace granvof::compare
