#include "solver/operators/box_of_grains.hpp"

#include <algorithm>

namespace granvof {
namespace {

// Cells. Blocks of 8 let a multigrid serve more steps, and cost the friction of a flat bed 1.5 times as much.
constexpr int block = 2;

}  // namespace

Range box_of_grains(const Grid& grid, const FaceInertia& inertia, double least) {
  const Layout& l = grid.cells;
  const int n = l.n[0];
  // A cell of at least f_s gives its x-faces at least half of that.
  const double least_of_face = 0.5 * least;
  const double* face = inertia.f_s[0].data();
  const Range grains = bounds_of_rows(l, [=](int j, int k) {
    const double* row = face + l.index(0, j, k);
    int from = 0, to = n;
    while (from <= n && row[from] < least_of_face) ++from;
    if (from > n) return Piece{};
    while (row[to] < least_of_face) --to;
    return Piece{from - 1, to + 1};
  });
  Range box{{0, 0, 0}, {0, 0, 0}};
  if (is_empty(grains)) return box;
  for (int d = 0; d < 3; ++d) {
    const bool whole = d >= grid.dim || l.periodic[d] || l.is_split(d);
    box.lower[d] = whole ? 0 : std::max(grains.lower[d] - 1, 0) / block * block;
    box.upper[d] = whole ? l.n[d] : std::min((grains.upper[d] + 1 + block - 1) / block * block, l.n[d]);
  }
  return box;
}

Layout faces_of(const Grid& grid, const Range& box, int d) {
  Layout l = part_of(grid.cells, box);
  if (!l.seam(d, true)) l.n[d] += 1;
  if (!l.periodic[d]) l.whole[d] += 1;
  return l;
}

}  // namespace granvof
