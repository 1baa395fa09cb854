#include "solver/grid/slabs.hpp"

#include <algorithm>
#include <cassert>

namespace granvof {

int direction_of_cut(const std::array<int, 3>& n, int dim) {
  return dim == 3 && n[2] >= n[0] ? 2 : 0;
}

Slab slab(int rows, int ranks, int rank) {
  int unit = 1;
  while (32 * unit * ranks <= rows) unit *= 2;
  const auto begin = [=](int r) {
    if (r == ranks) return rows;
    const long units = (2L * rows * r / ranks + unit) / (2L * unit);  // the nearest
    return static_cast<int>(units) * unit;
  };
  return {begin(rank), begin(rank + 1) - begin(rank)};
}

int most_slabs(const std::array<int, 3>& n, int dim) {
  return std::max(1, n[direction_of_cut(n, dim)] / least_rows_of_a_slab);
}

Layout slab_of(const Layout& whole, int dim, int ranks, int rank) {
  assert(ranks <= most_slabs(whole.n, dim));
  const int d = direction_of_cut(whole.n, dim);
  const Slab own = slab(whole.n[d], ranks, rank);
  std::array<int, 3> n = whole.n;
  n[d] = own.rows;
  Layout part = Layout::make(n, whole.ghost, whole.periodic);
  part.communicator = whole.communicator;
  part.whole = whole.n;
  part.first[d] = own.first;
  return part;
}

}  // namespace granvof
