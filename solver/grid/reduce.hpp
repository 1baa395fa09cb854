// Sums and largest values over the values of a box: of all processes that share it, and the only ones there
// are. A loop that adds up by itself would know its own process alone.
//
// Rows in parallel. A sum does not depend on the number of threads: rows are added up in fixed blocks, and
// the blocks in their order. (A reduction of OpenMP adds up in the order in which threads arrive.) Bodies as
// those of for_each.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/grid/communicator.hpp"
#include "solver/grid/for_each.hpp"

namespace granvof {

// Several sums of one loop: named scalars in a simd reduction vectorise, an array of sums behind a call does
// not, so a row adds up by itself.
template <std::size_t N>
struct Sums {
  std::array<double, N> values{};
  Sums& operator+=(const Sums& other) {
    for (std::size_t i = 0; i < N; ++i) values[i] += other.values[i];
    return *this;
  }
};

// Places of a row from `begin` to before `end`; none as it is made.
struct Piece {
  int begin = 0, end = 0;
};

namespace of_process {

// Blocks of a sum; more threads than that have nothing to do in it.
inline constexpr int sum_blocks = 64;

// Sum of row(j, k), a number or Sums, over the rows of the range.
template <typename Row>
inline auto sum_rows(const Range& r, Row&& row) {
  using Sum = decltype(row(0, 0));
  const int ny = r.upper[1] - r.lower[1], rows = ny * (r.upper[2] - r.lower[2]);
  std::array<Sum, sum_blocks> partial{};
  // A function of its own for one thread and for several: two copies of a loop may be rounded in two ways.
  const auto add_up = [&](int block) __attribute__((noinline)) {
    const auto begin = [=](int b) { return static_cast<int>(static_cast<long>(rows) * b / sum_blocks); };
    Sum sum{};
    for (int n = begin(block); n < begin(block + 1); ++n)
      sum += row(r.lower[1] + n % ny, r.lower[2] + n / ny);
    partial[static_cast<std::size_t>(block)] = sum;
  };
  if (worth_threads(r)) {
    const bool flush = FlushDenormals::on();
#pragma omp parallel
    {
      const FlushDenormals as_caller(flush);
#pragma omp for schedule(static)
      for (int block = 0; block < sum_blocks; ++block) add_up(block);
    }
  } else {
    for (int block = 0; block < sum_blocks; ++block) add_up(block);
  }
  Sum total{};
  for (const Sum& part : partial) total += part;
  return total;
}

// Sum of body(index).
template <typename Body>
inline double sum_over(const Layout& l, const Range& r, Body&& body) {
  const int length = r.upper[0] - r.lower[0];
  return sum_rows(r, [&](int j, int k) {
    const std::ptrdiff_t start = l.index(r.lower[0], j, k);
    const auto of_row = body;
    double line = 0.0;
#pragma omp simd reduction(+ : line)
    for (int i = 0; i < length; ++i) line += of_row(start + i);
    return line;
  });
}

// The largest of some values, and how many of them are not numbers: a flag keeps the loop from being
// vectorised.
struct Largest {
  double value, not_numbers = 0.0;
};

// Largest row(j, k), a Largest, of the rows of the range, at least `floor`.
template <typename Row>
inline Largest max_rows(const Range& r, double floor, Row&& row) {
  double largest = floor, not_numbers = 0.0;
  if (worth_threads(r)) {
    const int ny = r.upper[1] - r.lower[1], rows = ny * (r.upper[2] - r.lower[2]);
    const bool flush = FlushDenormals::on();
#pragma omp parallel reduction(max : largest) reduction(+ : not_numbers)
    {
      const FlushDenormals as_caller(flush);
#pragma omp for schedule(static)
      for (int n = 0; n < rows; ++n) {
        const Largest line = row(r.lower[1] + n % ny, r.lower[2] + n / ny);
        largest = line.value > largest ? line.value : largest;
        not_numbers += line.not_numbers;
      }
    }
  } else {
    for (int k = r.lower[2]; k < r.upper[2]; ++k)
      for (int j = r.lower[1]; j < r.upper[1]; ++j) {
        const Largest line = row(j, k);
        largest = line.value > largest ? line.value : largest;
        not_numbers += line.not_numbers;
      }
  }
  return {largest, not_numbers};
}

// The same of numbers body(j, k) >= 0 over a whole box.
template <typename Body>
inline Largest max_rows(const Layout& l, Body&& body) {
  return max_rows(Range::all(l), 0.0, [&](int j, int k) {
    const double v = body(j, k);
    return Largest{v, v == v ? 0.0 : 1.0};
  });
}

// Least range that holds, of every row, the places that row(j, k) names.
template <typename Row>
inline Range bounds_of_rows(const Range& r, Row&& row) {
  Range bounds{r.upper, r.lower};
  for (int k = r.lower[2]; k < r.upper[2]; ++k)
    for (int j = r.lower[1]; j < r.upper[1]; ++j) {
      const Piece piece = row(j, k);
      if (piece.end <= piece.begin) continue;
      const std::array<int, 3> first{piece.begin, j, k}, end{piece.end, j + 1, k + 1};
      for (int d = 0; d < 3; ++d) {
        bounds.lower[d] = first[d] < bounds.lower[d] ? first[d] : bounds.lower[d];
        bounds.upper[d] = end[d] > bounds.upper[d] ? end[d] : bounds.upper[d];
      }
    }
  return bounds;
}

}  // namespace of_process

// The same of all processes that share the box of `l`; NaN if one of their values is not a number.
inline double of_all(const Layout& l, const of_process::Largest& mine) {
  std::array<double, 2> all{mine.value, mine.not_numbers};
  if (l.communicator != nullptr) l.communicator->max(all);
  return all[1] == 0.0 ? all[0] : __builtin_nan("");
}
template <std::size_t N>
inline Sums<N> of_all(const Layout& l, Sums<N> mine) {
  if (l.communicator != nullptr) l.communicator->sum(mine.values);
  return mine;
}
inline double of_all(const Layout& l, double sum) {
  return of_all(l, Sums<1>{{sum}}).values[0];
}

// Whether all of them say so.
inline bool everywhere(const Layout& l, bool here) {
  double denied = here ? 0.0 : 1.0;
  if (l.communicator != nullptr) l.communicator->max({&denied, 1});
  return denied == 0.0;
}

// Sum over the range of body(index), in an order that is that of the range alone.
template <typename Body>
inline double sum_over(const Layout& l, const Range& r, Body&& body) {
  return of_all(l, of_process::sum_over(l, r, body));
}

// Largest value over the range of body(index), at least `floor`; a NaN anywhere is returned as NaN.
template <typename Body>
inline double max_over(const Layout& l, const Range& r, double floor, Body&& body) {
  const int length = r.upper[0] - r.lower[0];
  return of_all(l, of_process::max_rows(r, floor, [&](int j, int k) {
                  const std::ptrdiff_t start = l.index(r.lower[0], j, k);
                  const auto of_row = body;
                  double line = floor, odd = 0.0;
#pragma omp simd reduction(max : line) reduction(+ : odd)
                  for (int i = 0; i < length; ++i) {
                    const double v = of_row(start + i);
                    line = v > line ? v : line;
                    odd += v == v ? 0.0 : 1.0;
                  }
                  return of_process::Largest{line, odd};
                }));
}

// Sum of body(item) over items that each belong to one process.
template <typename Items, typename Body>
inline double sum_of(const Layout& l, const Items& items, Body&& body) {
  double total = 0.0;
  for (const auto& item : items) total += body(item);
  return of_all(l, total);
}

// Sum of (place along d + 1/2) body(index): the first moment about the lower side, in cells.
template <typename Body>
inline double moment_over(const Layout& l, const Range& r, int d, Body&& body) {
  double moment = 0.0;
  Range layer = r;
  for (int at = r.lower[d]; at < r.upper[d]; ++at) {
    layer.lower[d] = at;
    layer.upper[d] = at + 1;
    moment += (at + 0.5) * of_process::sum_over(l, layer, body);
  }
  return of_all(l, moment);
}

// Sum of body(j, k), a number or Sums, over the rows along x of the box; of body(index of the first value,
// number of values) over those of a range.
template <typename Body>
inline auto sum_rows(const Layout& l, Body&& body) {
  return of_all(l, of_process::sum_rows(Range::all(l), body));
}
template <typename Body>
inline auto sum_rows(const Layout& l, const Range& r, Body&& body) {
  return of_all(l, of_process::sum_rows(r, [&](int j, int k) {
                  const auto of_row = body;
                  return of_row(l.index(r.lower[0], j, k), r.upper[0] - r.lower[0]);
                }));
}

// Largest body(j, k) >= 0 over the rows of the box; infinity if one of them is not a number.
template <typename Body>
inline double max_rows(const Layout& l, Body&& body) {
  const double largest = of_all(l, of_process::max_rows(l, body));
  return largest == largest ? largest : __builtin_inf();
}

// Over several boxes that one set of processes shares, in one message: body(b) is the body for box b, of
// values for sum_over(), of rows for the others.
template <typename Body>
inline double sum_over(const std::vector<Layout>& boxes, Body&& body) {
  double total = 0.0;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    total += of_process::sum_over(boxes[b], Range::all(boxes[b]), body(b));
  return of_all(boxes.front(), total);
}
template <std::size_t N, typename Body>
inline double sum_rows(const std::array<Layout, N>& boxes, Body&& body) {
  double total = 0.0;
  for (std::size_t b = 0; b < N; ++b) total += of_process::sum_rows(Range::all(boxes[b]), body(b));
  return of_all(boxes.front(), total);
}
template <typename Body>
inline double max_rows(const std::vector<Layout>& boxes, Body&& body) {
  of_process::Largest mine{0.0};
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const of_process::Largest here = of_process::max_rows(boxes[b], body(b));
    mine = {here.value > mine.value ? here.value : mine.value, mine.not_numbers + here.not_numbers};
  }
  const double largest = of_all(boxes.front(), mine);
  return largest == largest ? largest : __builtin_inf();
}

// Least range that holds, of every row along x of the box, the places that body(j, k), a Piece, names; empty
// (upper <= lower) where there are none. A piece may reach beyond its row.
template <typename Body>
inline Range bounds_of_rows(const Layout& l, Body&& body) {
  Range bounds = of_process::bounds_of_rows(Range::all(l), body);
  if (l.communicator == nullptr) return bounds;
  std::array<double, 6> ends{};
  for (std::size_t d = 0; d < 3; ++d) {
    ends[d] = -bounds.lower[d];
    ends[3 + d] = bounds.upper[d];
  }
  l.communicator->max(ends);
  for (std::size_t d = 0; d < 3; ++d) {
    bounds.lower[d] = -static_cast<int>(ends[d]);
    bounds.upper[d] = static_cast<int>(ends[3 + d]);
  }
  return bounds;
}

}  // namespace granvof
