// Fluxes that satisfy continuity (4) to rounding, whatever the tolerance they were solved to.
//
// The pressure solver leaves div(f_s u_s + f_c u_c) = r, |r| dt <= volume_tolerance. f_s and f_l follow their
// fluxes exactly, but f_c is 1 - f_s: what r takes from a cell full of liquid is liquid lost. A bed at rest
// with the water's level inside it lost 6e-4 of its water in a minute. So the continuous phase carries r
// away: upwards, column by column, and out through an open top. Without one the sums of the columns are first
// evened out along z and x, in equal parts through the open faces of each side of a column; their total is
// zero but for rounding. A periodic direction is evened out without a mean flow through its ends, so that no
// column is the first. A closed gate is not passed: the fluid on either side of it keeps its own balance.
//
// The velocities stay as they are: their projection is as good as the tolerance says.
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/aperture.hpp"

namespace granvof {

// Adds to flux_c [m/s] what closes continuity: |div(flux_s + flux_c)| is rounding on return. Closed faces are
// left alone; both fluxes with periodic ends joined on entry, and on return.
void close_continuity(const Grid& grid, const Boundary& boundary, const Aperture& aperture,
                      const FaceField& flux_s, FaceField& flux_c);

}  // namespace granvof
