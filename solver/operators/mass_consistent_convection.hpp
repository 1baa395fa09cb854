// Convection of momentum with the mass that carries it.
//
// The advective form, -(u . grad) u, moves velocities and asks for no mass: a face takes up momentum at its
// own speed. Where a front of grains or water arrives there is next to no mass yet and the speed is the
// gas's, so that what arrives is stopped there, on every grid: a cloud in free fall piles up in its own
// front. (5) and (6) conserve momentum and mass together: with the mass m of the face's control volume and
// the mass fluxes F into it (negative out of it),
//   m_new = m + dt sum F,   m_new (u_new - u) = dt sum F (u_side - u),
// u_side upwind or limited (for two fluids Rudman 1998, Int. J. Numer. Meth. Fluids 28).
// Equations: docs/theory/balances.md, the form: docs/theory/choices.md.
#pragma once

#include "solver/grid/field.hpp"
#include "solver/grid/inner_walls.hpp"

namespace granvof {

// Convective acceleration [m/s2] of component d on `faces` (inner ones). m: mass of the phase in cells, in
// any unit per volume; u its velocity [m/s], two layers of ghosts of both filled; dt [s] > 0. `limited`: by
// van Leer's reconstruction where a face and its donor hold more than `least` of m and the step is short for
// them, else upwind; beside walls inside the tank slopes are made with what is seen of them. Returns what
// convective_acceleration() does, in the unit of m [m2/s3].
double convect_with_mass(const Field& m, bool limited, double least, const Grid& grid,
                         const InnerWalls& walls, const FaceField& u, int d, const Range& faces, double dt,
                         Field& acceleration);

}  // namespace granvof
