// The double-precision operator on one row: sums over faces straight from the caller's coefficient arrays.
#pragma once

#include <array>
#include <cstddef>

#include "solver/grid/layout.hpp"

namespace granvof::linear::rows {

// Coefficients of one row of cells, from arrays in the caller's layout.
struct FaceRow {
  const double* x = nullptr;  // face below cell i; the last cell's upper face is `x_end`
  double x_end = 0.0;
  const double *y = nullptr, *y_upper = nullptr;  // faces below and above the row
  const double *z = nullptr, *z_upper = nullptr;
  int n = 0;  // cells

  // The same of `count` cells from `start` on.
  FaceRow from(int start, int count) const {
    FaceRow part{*this};
    if (x != nullptr && start + count < n) part.x_end = x[start + count];
    for (const double** faces : {&part.x, &part.y, &part.y_upper, &part.z, &part.z_upper})
      if (*faces != nullptr) *faces += start;
    part.n = count;
    return part;
  }
};

// `zeros`: at least n[0] values of 0, for the faces above the last row.
inline FaceRow face_row(const std::array<const double*, 3>& lower, const Layout& l, int j, int k,
                        const double* zeros) {
  FaceRow row;
  row.n = l.n[0];
  const std::ptrdiff_t start = l.index(0, j, k);
  const auto upper = [&](int d, int position) {
    if (position + 1 < l.n[d] || (l.is_split(d) && l.seam(d, true))) return lower[d] + start + l.stride[d];
    return l.periodic[d] ? lower[d] + start - position * l.stride[d] : zeros;
  };
  if (lower[0]) {
    row.x = lower[0] + start;
    row.x_end = !l.seam(0, true) ? 0.0 : row.x[l.is_split(0) ? l.n[0] : 0];
  }
  if (lower[1]) {
    row.y = lower[1] + start;
    row.y_upper = upper(1, j);
  }
  if (lower[2]) {
    row.z = lower[2] + start;
    row.z_upper = upper(2, k);
  }
  return row;
}

// Forced inline: a call that stays in the loop keeps it from being vectorised.
//
// Sum over the faces of cell i of a (x - x_neighbour). v: the values of this row, neighbours sy and sz away.
template <bool X, bool Y, bool Z, typename T>
[[gnu::always_inline]] inline double face_sum(const FaceRow& a, double x_upper, const T* v, std::ptrdiff_t i,
                                              std::ptrdiff_t sy, std::ptrdiff_t sz) {
  const double own = v[i];
  double sum = 0.0;
  if constexpr (X) sum += a.x[i] * (own - v[i - 1]) + x_upper * (own - v[i + 1]);
  if constexpr (Y) sum += a.y[i] * (own - v[i - sy]) + a.y_upper[i] * (own - v[i + sy]);
  if constexpr (Z) sum += a.z[i] * (own - v[i - sz]) + a.z_upper[i] * (own - v[i + sz]);
  return sum;
}

// store(i, sum over the faces of cell i) for the n cells of a row.
template <bool X, bool Y, bool Z, typename T, typename Store>
[[gnu::always_inline]] inline void face_sums(int n, const FaceRow& a, const T* v, std::ptrdiff_t sy,
                                             std::ptrdiff_t sz, Store&& store) {
  if constexpr (X) {
#pragma omp simd
    for (int i = 0; i < n - 1; ++i) store(i, face_sum<X, Y, Z>(a, a.x[i + 1], v, i, sy, sz));
    store(n - 1, face_sum<X, Y, Z>(a, a.x_end, v, n - 1, sy, sz));
  } else {
#pragma omp simd
    for (int i = 0; i < n; ++i) store(i, face_sum<X, Y, Z>(a, 0.0, v, i, sy, sz));
  }
}

}  // namespace granvof::linear::rows
