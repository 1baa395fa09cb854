// Convective acceleration -(u . grad) u of a staggered velocity, first-order upwind.
//
// The advective form is used for both phases: it needs no division by a phase fraction that may vanish and no
// mass flux that a 1:1000 interface makes inconsistent.
#pragma once

#include "solver/grid/field.hpp"

namespace granvof {

// Writes the acceleration [m/s2] of component d on `faces`; two ghost layers of u must be filled. With
// `limited` the one-sided differences are replaced by van Leer limited ones (second order where u is smooth).
void convective_acceleration(const Grid& grid, const FaceField& u, int d, const Range& faces, bool limited,
                             Field& acceleration);

}  // namespace granvof
