// Face coefficients of a cell-centred symmetric operator, as every solver of this directory takes them.
#pragma once

#include <array>

namespace granvof::linear {

// lower[d][index] >= 0 is the coefficient of the face between a cell and its lower neighbour in direction d,
// in the memory layout of the cells. On the lower boundary of the box it must be 0 unless the direction is
// periodic; then it couples to the opposite end. The face above the last cell is never read (ghosts are not
// trusted), but for a box that is cut among processes: there it is the neighbour's, and must be filled.
// nullptr: the direction is not coupled, and costs nothing.
//
// The operator is (A x)_c = mass_c x_c + sum over faces of a (x_c - x_neighbour).
struct Faces {
  std::array<const double*, 3> lower{nullptr, nullptr, nullptr};
};

}  // namespace granvof::linear
