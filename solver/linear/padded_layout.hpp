// How the values of the linear solvers lie in memory: rows padded to whole vectors, on cache lines.
#pragma once

#include <array>
#include <cstddef>

#include "solver/grid/layout.hpp"

namespace granvof::linear {

inline constexpr int lanes = 16;  // values a row is padded to: one cache line of float, two of double

inline int padded(int n) {
  return (n + lanes - 1) / lanes * lanes;
}

// The layout of the solvers' own values. Rows start on a cache line and are padded to whole vectors with
// values that stay 0, so that loops need no remainder. Ghost rows exist only in directions of several cells;
// along x a ghost is needed only at seams (else the faces on both ends are 0).
// `like`: the layout whose box this is: its place in the whole, its periodic ends, and whom it is shared
// with.
inline Layout padded_layout(const Layout& like) {
  Layout l;
  const std::array<int, 3>& n = like.n;
  l.n = n;
  l.first = like.first;
  l.whole = like.whole;
  l.communicator = like.communicator;
  for (int d = 0; d < 3; ++d) l.periodic[d] = l.whole[d] > 1 && like.periodic[d];
  l.ghost = {l.any_seam(0) ? 1 : 0, l.whole[1] > 1 ? 1 : 0, l.whole[2] > 1 ? 1 : 0};
  std::ptrdiff_t row = padded(n[0] + 2 * l.ghost[0]);
  if (row % 512 == 0) row += lanes;  // rows a power of two apart evict each other from the first-level cache
  l.stride = {1, row, row * (n[1] + 2 * l.ghost[1])};
  l.origin = lanes + l.ghost[1] * l.stride[1] + l.ghost[2] * l.stride[2];
  l.size = static_cast<std::size_t>(2 * lanes + l.stride[2] * (n[2] + 2 * l.ghost[2]));
  return l;
}

}  // namespace granvof::linear
