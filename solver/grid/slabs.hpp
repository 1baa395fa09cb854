// How a tank is cut into slabs, one for each of several processes.
//
// Columns along the vertical stay whole: the hydrostatic start, the surface of a bed and the arrest of thin
// layers work their way along them. Slabs are cut across the longest of the other directions, where fewest
// values pass between them.
#pragma once

#include <array>

#include "solver/grid/layout.hpp"

namespace granvof {

// Two ghost layers are those of one neighbour, and the first two levels of multigrid stay on the slab.
inline constexpr int least_rows_of_a_slab = 4;

struct Slab {
  int first = 0, rows = 0;
};

// 0 or 2: the direction across which a tank of n cells in `dim` directions is cut.
int direction_of_cut(const std::array<int, 3>& n, int dim);

// Slab `rank` of `ranks` of a direction of `rows` rows. They are alike but for whole pairs, pairs of pairs
// and so on, as far as that moves no more than a sixteenth of one: so many levels of multigrid are slabs of
// the same cut.
Slab slab(int rows, int ranks, int rank);

// Most processes that a tank of n cells can be cut among; at least 1.
int most_slabs(const std::array<int, 3>& n, int dim);

// The slab of a process of a layout that is whole.
Layout slab_of(const Layout& whole, int dim, int ranks, int rank);

}  // namespace granvof
