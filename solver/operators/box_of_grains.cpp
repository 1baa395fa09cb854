#include "solver/operators/box_of_grains.hpp"

#include <algorithm>

namespace granvof {
namespace {

// Cells. Blocks of 8 let a multigrid serve more steps, and cost the friction of a flat bed 1.5 times as much.
constexpr int block = 2;

}  // namespace

Range box_of_grains(const Grid& grid, const FaceInertia& inertia) {
  const Layout& l = grid.cells;
  const int n = l.n[0];
  // A cell of at least f_s gives its x-faces at least half of that.
  constexpr double least = 0.5 * least_solid_fraction;
  std::array<int, 3> first = l.n, last{-1, -1, -1};
  for (int k = 0; k < l.n[2]; ++k) {
    for (int j = 0; j < l.n[1]; ++j) {
      const double* row = inertia.f_s[0].data() + l.index(0, j, k);
      int from = 0, to = n;
      while (from <= n && row[from] < least) ++from;
      if (from > n) continue;
      while (row[to] < least) --to;
      const std::array<int, 3> low{from - 1, j, k}, high{to, j, k};
      for (int d = 0; d < 3; ++d) {
        first[d] = std::min(first[d], low[d]);
        last[d] = std::max(last[d], high[d]);
      }
    }
  }
  Range box{{0, 0, 0}, {0, 0, 0}};
  if (last[0] < 0) return box;
  for (int d = 0; d < 3; ++d) {
    const bool whole = d >= grid.dim || l.periodic[d];
    box.lower[d] = whole ? 0 : std::max(first[d] - 1, 0) / block * block;
    box.upper[d] = whole ? l.n[d] : std::min((last[d] + 2 + block - 1) / block * block, l.n[d]);
  }
  return box;
}

Layout cells_of(const Grid& grid, const Range& box) {
  Layout l = grid.cells;
  l.origin = l.index(box.lower[0], box.lower[1], box.lower[2]);
  for (int d = 0; d < 3; ++d) l.n[d] = box.upper[d] - box.lower[d];
  return l;
}

Layout faces_of(const Grid& grid, const Range& box, int d) {
  Layout l = cells_of(grid, box);
  if (!l.periodic[d]) l.n[d] += 1;
  return l;
}

}  // namespace granvof
