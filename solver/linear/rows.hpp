// Loops over the rows (lines along x) of a box, in threads only where that pays.
#pragma once

#include <algorithm>
#include <cstddef>

#include <omp.h>

#include "solver/grid/for_each.hpp"
#include "solver/grid/layout.hpp"
#include "solver/grid/ordered_sum.hpp"
#include "solver/linear/flush_denormals.hpp"

namespace granvof::linear {

// A separate serial branch instead of `if` in the pragma: starting a team of one costs more than a coarse
// level.
inline bool worth_threads(const Layout& l) {
  return l.count() > std::size_t(cells_that_pay_for_threads) && omp_get_max_threads() > 1;
}

// body(j, k) for every row.
template <typename Body>
inline void for_rows(const Layout& l, Body&& body) {
  const int ny = l.n[1], nz = l.n[2];
  if (worth_threads(l)) {
#pragma omp parallel
    {
      const FlushDenormals flush;
#pragma omp for schedule(static)
      for (int row = 0; row < ny * nz; ++row) body(row % ny, row / ny);
    }
  } else {
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) body(j, k);
  }
}

// Sum over the rows of body(j, k), a number or a struct with +=; its order does not depend on the threads.
template <typename Body>
inline auto sum_rows(const Layout& l, Body&& body) {
  const int ny = l.n[1], rows = l.n[1] * l.n[2];
  std::array<decltype(body(0, 0)), sum_blocks> partial{};
  const auto add_up = [&](int block) {
    partial[block] = sum_of_block(rows, block, [&](int row) { return body(row % ny, row / ny); });
  };
  if (worth_threads(l)) {
#pragma omp parallel
    {
      const FlushDenormals flush;
#pragma omp for schedule(static)
      for (int block = 0; block < sum_blocks; ++block) add_up(block);
    }
  } else {
    for (int block = 0; block < sum_blocks; ++block) add_up(block);
  }
  return sum_of_blocks(partial);
}

// Largest body(j, k) >= 0 over the rows; infinity if one of them is not a number.
template <typename Body>
inline double max_rows(const Layout& l, Body&& body) {
  const int ny = l.n[1], nz = l.n[2];
  double largest = 0.0;
  const auto finite = [](double v) { return v == v ? v : __builtin_inf(); };
  if (worth_threads(l)) {
#pragma omp parallel reduction(max : largest)
    {
      const FlushDenormals flush;
#pragma omp for schedule(static)
      for (int row = 0; row < ny * nz; ++row) largest = std::max(largest, finite(body(row % ny, row / ny)));
    }
  } else {
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) largest = std::max(largest, finite(body(j, k)));
  }
  return largest;
}

// Calls visit.template operator()<X, Y, Z>() for the coupled directions given at run time.
template <typename Visit>
inline decltype(auto) with_directions(const std::array<bool, 3>& coupled, Visit&& visit) {
  switch ((coupled[0] ? 1 : 0) + (coupled[1] ? 2 : 0) + (coupled[2] ? 4 : 0)) {
    case 1:
      return visit.template operator()<true, false, false>();
    case 2:
      return visit.template operator()<false, true, false>();
    case 3:
      return visit.template operator()<true, true, false>();
    case 4:
      return visit.template operator()<false, false, true>();
    case 5:
      return visit.template operator()<true, false, true>();
    case 6:
      return visit.template operator()<false, true, true>();
    case 7:
      return visit.template operator()<true, true, true>();
    default:
      return visit.template operator()<false, false, false>();
  }
}

}  // namespace granvof::linear
