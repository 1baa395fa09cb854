// Fields and scalars of one instant of a coupled run, in the project's output form.
#pragma once

#include <optional>

#include "reference/demvof/coupling/coupled_run.hpp"
#include "solver/output/cell_fields.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

// f_s, u_s and granular temperature from the beads by the mapping of the coupling; `scene` with demvof's
// grid, `time` since the release [s]. Theta = <|v - u_s|^2> / 3, about the mean velocity of the cell.
granvof::CellFields snapshot(const CoupledRun& run, const granvof::Scene& scene, double time);

// x left of which 99.5 % of the beads have their centres [m].
double bead_front(const BeadState& beads);
double bead_rms_speed(const BeadState& beads);  // [m/s]
// Height below which 99.5 % of the beads' upper edges lie [m].
double bed_top(const BeadState& beads, double diameter);
// Mean u_x of the lowest layer of beads (centres below 1.5 d) over that of the next (to 2.5 d), among the
// beads that have left the initial bed, x > from; how far the floor lets the lowest layer slide. None where
// nothing moves. [-]
std::optional<double> floor_slip(const BeadState& beads, double diameter, double from);
// Pressure along the floor cells under the bed's initial length, on the floor or an obstacle that stands on
// it, in excess of the liquid's own weight rho_l g (level - y) [Pa].
double excess_base_pressure(const CoupledRun& run, const granvof::Scene& scene);

}  // namespace demvof
