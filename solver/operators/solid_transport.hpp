// Solid volume balance (1), and what the grains carry along (25), from the fluxes of the pressure step.
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/grid/boundary.hpp"

namespace granvof {

// Reduces solid fluxes out of cells that would run empty and hands what they lose to the fluid's flux through
// the same face, so that continuity (4) stays closed and f_s >= 0 exactly. Only faces whose flow turned
// during the pressure step are ever touched. flux per area [m/s].
void keep_solid_positive(const Grid& grid, const Boundary& boundary, double dt, const Field& f_s,
                         FaceField& flux_s, FaceField& flux_c);

// f_s^{n+1} = f_s^n - dt div(flux_s). Conservative to rounding.
void transport_solid(const Grid& grid, double dt, const Field& f_s, const FaceField& flux_s, Field& f_s_new);

// Solid volume that leaves through the sides in dt, net [m3].
double solid_left(const Grid& grid, double dt, const FaceField& flux_s);

// Eq (25): phi of the solid, in [0, 1], upwind along flux_s; phi keeps its old value where no grains are
// left. One ghost layer of phi must be filled.
void transport_with_grains(const Grid& grid, double dt, const Field& f_s, const Field& f_s_new,
                           const FaceField& flux_s, const Field& phi, Field& phi_new);

// Largest share of a cell's content that leaves it in dt: outflow Courant number of the phase with fraction
// f. Cells that hold less than `least` are not looked at.
double outflow_courant(const Grid& grid, double dt, const Field& fraction, bool complement, double least,
                       const FaceField& flux);

}  // namespace granvof
