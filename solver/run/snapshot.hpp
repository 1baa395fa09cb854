// The state as the output contract wants it: cell centres, C order, no ghosts.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/run/state.hpp"

namespace granvof {

CellFields cell_fields(const Grid& grid, const State& s);

}  // namespace granvof
