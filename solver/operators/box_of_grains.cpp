#include "solver/operators/box_of_grains.hpp"

#include <algorithm>

namespace granvof {
namespace {

// Cells. Blocks of 8 let a multigrid serve more steps, and cost the friction of a flat bed 1.5 times as much.
constexpr int block = 2;

// The box around what every row of cells has: piece(first value of the row), with one more row on each side.
template <typename PieceOf>
Range box_around(const Grid& grid, PieceOf&& piece) {
  const Layout& l = grid.cells;
  const Range grains = bounds_of_rows(l, [=](int j, int k) { return piece(l.index(0, j, k)); });
  Range box{{0, 0, 0}, {0, 0, 0}};
  if (is_empty(grains)) return box;
  for (int d = 0; d < 3; ++d) {
    const bool whole = d >= grid.dim || l.periodic[d] || l.is_split(d);
    box.lower[d] = whole ? 0 : std::max(grains.lower[d] - 1, 0) / block * block;
    box.upper[d] = whole ? l.n[d] : std::min((grains.upper[d] + 1 + block - 1) / block * block, l.n[d]);
  }
  return box;
}

// From the first to the last of n values that hold grains.
template <typename Holds>
Piece piece_of_row(int n, Holds&& holds) {
  int from = 0, to = n - 1;
  while (from < n && !holds(from)) ++from;
  if (from == n) return {};
  while (!holds(to)) --to;
  return {from, to + 1};
}

}  // namespace

Range box_of_grains(const Grid& grid, const FaceInertia& inertia, double least) {
  if (!inertia.holds_grains) return {{0, 0, 0}, {0, 0, 0}};
  const int n = grid.cells.n[0];
  // A cell of at least f_s gives its x-faces at least half of that.
  const double least_of_face = 0.5 * least;
  const double* face = inertia.f_s[0].data();
  return box_around(grid, [=](std::ptrdiff_t row) {
    const Piece faces = piece_of_row(n + 1, [=](int i) { return !(face[row + i] < least_of_face); });
    return faces.end > faces.begin ? Piece{faces.begin - 1, faces.end} : faces;
  });
}

Range box_of_grains(const Grid& grid, const Field& now, const Field& then, double least) {
  const int n = grid.cells.n[0];
  const double *f0 = now.data(), *f1 = then.data();
  return box_around(grid, [=](std::ptrdiff_t row) {
    return piece_of_row(n, [=](int i) { return !(f0[row + i] < least && f1[row + i] < least); });
  });
}

Layout faces_of(const Grid& grid, const Range& box, int d) {
  Layout l = part_of(grid.cells, box);
  if (!l.seam(d, true)) l.n[d] += 1;
  if (!l.periodic[d]) l.whole[d] += 1;
  return l;
}

}  // namespace granvof
