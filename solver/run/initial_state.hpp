// What a run begins with.
#pragma once

#include "solver/state/state.hpp"

namespace granvof {

// The state at the start of a scene: the bed and the liquid by volume share of each cell, both at rest, fluid
// pressure hydrostatic, no solid pressure: the packing takes the bed's weight in the first steps. Where the
// model carries the packing, the bed bears it from the start.
State initial_state(const Grid& grid, const Scene& scene, const Boundary& boundary);

}  // namespace granvof
