// The part of the grid that holds grains: what all that is of grains alone needs to work on.
#pragma once

#include "solver/operators/mixture.hpp"

namespace granvof {

// Cells around every face with f_s >= `least` and one more row on each side, in whole pairs of cells (a
// multigrid built for it then serves several steps), the whole length of directions that are periodic or cut
// among processes. Empty (upper = lower) without grains. inertia.f_s must reach one ghost layer.
Range box_of_grains(const Grid& grid, const FaceInertia& inertia, double least = least_solid_fraction);

// The same around every cell with `least` of f_s now or then.
Range box_of_grains(const Grid& grid, const Field& now, const Field& then,
                    double least = least_solid_fraction);

// The faces of direction d of a part of the cells, the upper ones included.
inline Range faces_of(Range cells, int d) {
  ++cells.upper[d];
  return cells;
}

// The same of `box` as a box of their own in the memory of the grid's layout.
Layout faces_of(const Grid& grid, const Range& box, int d);

}  // namespace granvof
