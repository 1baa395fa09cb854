// The state as the output contract wants it: cell centres, C order, no ghosts.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/state/state.hpp"

namespace granvof {

CellFields cell_fields(const Grid& grid, const State& s);

// The same at `time` between two states, earlier.time < time <= later.time [s]: linear in time, of higher
// order than the step (Euler) that led from one to the other, and a mean of the two, so that it keeps every
// bound that both keep. Volumes are linear: f_s, alpha f_c, phi f_s; so are pressures, velocities and Theta
// f_s.
CellFields cell_fields(const Grid& grid, const State& earlier, const State& later, double time);

// The ledger at that time: every term linear, stored energies too, so that the budget closes as it does on
// the states. Stored energies are quadratic in the velocity: those of the interpolated fields differ by
// O(dt^2).
EnergyTerms energy_terms_at(const State& earlier, const State& later, double time);

}  // namespace granvof
