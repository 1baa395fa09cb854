// The part of the grid that holds grains: what the friction solver needs to work on.
#pragma once

#include "solver/operators/mixture.hpp"

namespace granvof {

// Cells around every face with f_s >= least_solid_fraction and one more row on each side, in whole pairs of
// cells (a multigrid built for it then serves several steps), the whole length of directions that are
// periodic or cut among processes. Empty
// (upper = lower) without grains. inertia.f_s must reach one ghost layer.
Range box_of_grains(const Grid& grid, const FaceInertia& inertia);

inline bool is_empty(const Range& r) {
  return r.upper[0] <= r.lower[0];
}

// The cells of `box` as a box of their own in the memory of the grid's layout; its faces of direction d
// likewise, the upper ones included.
Layout cells_of(const Grid& grid, const Range& box);
Layout faces_of(const Grid& grid, const Range& box, int d);

}  // namespace granvof
