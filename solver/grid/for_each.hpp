// Loops over the values of a box, rows in parallel, x innermost and vectorised. What they sum up or compare
// is in reduce.hpp.
//
// A body captures by value and writes only what belongs to its own index (gather, never scatter). Every row
// has a copy of it: of an object that others see, what a body writes might change what it has captured, and
// no compiler vectorises that. Threads start only where a loop is long enough to pay for them; `threads`
// comes from the run, there is no global state.
#pragma once

#include <cstddef>

#include <omp.h>

#include "solver/grid/flush_denormals.hpp"
#include "solver/grid/layout.hpp"

namespace granvof {

// Half-open index range of a box; the full box of a layout is {0,0,0} to n.
struct Range {
  std::array<int, 3> lower{0, 0, 0};
  std::array<int, 3> upper{1, 1, 1};
  static Range all(const Layout& l) { return {{0, 0, 0}, l.n}; }
  bool contains(const std::array<int, 3>& at) const {
    for (int d = 0; d < 3; ++d)
      if (at[d] < lower[d] || at[d] >= upper[d]) return false;
    return true;
  }
  bool operator==(const Range&) const = default;
};

// What lies in both.
inline Range common(const Range& a, const Range& b) {
  Range both;
  for (int d = 0; d < 3; ++d) {
    both.lower[d] = a.lower[d] > b.lower[d] ? a.lower[d] : b.lower[d];
    both.upper[d] = a.upper[d] < b.upper[d] ? a.upper[d] : b.upper[d];
  }
  return both;
}

inline bool is_empty(const Range& r) {
  return r.upper[0] <= r.lower[0] || r.upper[1] <= r.lower[1] || r.upper[2] <= r.lower[2];
}

// visit(range) for every part of `all` that lies outside `inner`, which lies within it.
template <typename Visit>
inline void for_each_part_outside(Range all, const Range& inner, Visit&& visit) {
  for (int d = 2; d >= 0; --d) {
    Range below = all, above = all;
    below.upper[d] = all.lower[d] = inner.lower[d];
    above.lower[d] = all.upper[d] = inner.upper[d];
    for (const Range& part : {below, above})
      if (!is_empty(part)) visit(part);
  }
}

// The values of a range as a box of their own in the memory of the whole; a range spans directions that are
// cut among processes.
inline Layout part_of(const Layout& whole, const Range& r) {
  Layout l = whole;
  l.origin = l.index(r.lower);
  for (int d = 0; d < 3; ++d) {
    if (l.is_split(d)) continue;
    l.n[d] = r.upper[d] - r.lower[d];
    l.periodic[d] = l.periodic[d] && l.n[d] == l.whole[d];
    l.whole[d] = l.n[d];
  }
  return l;
}

// visit(std::array<int, 3> place) for every place of the range, x fastest, one after the other: for what is
// done once, or in an order.
template <typename Visit>
inline void for_each_place(const Range& r, Visit&& visit) {
  for (int k = r.lower[2]; k < r.upper[2]; ++k)
    for (int j = r.lower[1]; j < r.upper[1]; ++j)
      for (int i = r.lower[0]; i < r.upper[0]; ++i) visit(std::array<int, 3>{i, j, k});
}

inline constexpr int cells_that_pay_for_threads = 8000;  // measured: below it a second thread costs more

// Where a second thread pays. A separate serial branch instead of `if` in the pragma: starting a team of one
// costs more than a coarse level.
inline bool worth_threads(const Range& r) {
  const long count =
      static_cast<long>(r.upper[0] - r.lower[0]) * (r.upper[1] - r.lower[1]) * (r.upper[2] - r.lower[2]);
  return count > cells_that_pay_for_threads && omp_get_max_threads() > 1;
}

// body(j, k) for every row along x of the range, for loops over values of several layouts at once. Every
// thread treats denormal numbers as the caller does.
template <typename Body>
inline void for_each_row(const Range& r, Body&& body) {
  const int ny = r.upper[1] - r.lower[1], rows = ny * (r.upper[2] - r.lower[2]);
  if (worth_threads(r)) {
    const bool flush = FlushDenormals::on();
#pragma omp parallel
    {
      const FlushDenormals as_caller(flush);
#pragma omp for schedule(static)
      for (int row = 0; row < rows; ++row) body(r.lower[1] + row % ny, r.lower[2] + row / ny);
    }
  } else {
    for (int k = r.lower[2]; k < r.upper[2]; ++k)
      for (int j = r.lower[1]; j < r.upper[1]; ++j) body(j, k);
  }
}

template <typename Body>
inline void for_each_row(const Layout& l, Body&& body) {
  for_each_row(Range::all(l), body);
}

// body(std::ptrdiff_t index) for every value in the range.
template <typename Body>
inline void for_each(const Layout& l, const Range& r, Body&& body) {
  const int length = r.upper[0] - r.lower[0];
  // A function of its own for one thread and for several: two copies of a loop may be rounded in two ways.
  const auto of_row = [&](int j, int k) __attribute__((noinline)) {
    const std::ptrdiff_t start = l.index(r.lower[0], j, k);
    const auto of_index = body;
#pragma omp simd
    for (int i = 0; i < length; ++i) of_index(start + i);
  };
  for_each_row(r, of_row);
}

template <typename Body>
inline void for_each(const Layout& l, Body&& body) {
  for_each(l, Range::all(l), body);
}

}  // namespace granvof
