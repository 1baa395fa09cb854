// Rows of a box, for loops that keep several sums at once: named scalars in a simd reduction vectorise, an
// array of sums behind a call does not.
#pragma once

#include "solver/grid/for_each.hpp"

namespace granvof {

// body(index of the first value, number of values) for every row along x, one after the other.
template <typename Body>
inline void for_each_row(const Layout& l, const Range& r, Body&& body) {
  for (int k = r.lower[2]; k < r.upper[2]; ++k)
    for (int j = r.lower[1]; j < r.upper[1]; ++j) body(l.index(r.lower[0], j, k), r.upper[0] - r.lower[0]);
}

}  // namespace granvof
