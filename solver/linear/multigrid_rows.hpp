// The inner loops of multigrid: one padded row each, contiguous, without remainder or branch.
//
// X, Y, Z say which directions are coupled; sy and sz are the strides of neighbours. Faces are scaled, so the
// diagonal is 1: (A x)_i = x_i - sum of face * x_neighbour.
#pragma once

#include <cmath>
#include <cstddef>

namespace granvof::linear::rows {

struct Stencil {  // pointers to the first value of a row
  const float* x_face;
  const float* y_face;
  const float* z_face;
  std::ptrdiff_t sy, sz;

  Stencil at(std::ptrdiff_t start) const { return {x_face + start, y_face + start, z_face + start, sy, sz}; }
};

template <bool X, bool Y, bool Z>
[[gnu::always_inline]] inline float neighbours(const Stencil& s, const float* x, std::ptrdiff_t i) {
  float sum = 0.0F;
  if constexpr (X) sum += s.x_face[i] * x[i - 1] + s.x_face[i + 1] * x[i + 1];
  if constexpr (Y) sum += s.y_face[i] * x[i - s.sy] + s.y_face[i + s.sy] * x[i + s.sy];
  if constexpr (Z) sum += s.z_face[i] * x[i - s.sz] + s.z_face[i + s.sz] * x[i + s.sz];
  return sum;
}

// The first two sweeps at once, from a zero guess: out = own * rhs + other * (faces * rhs of neighbours).
template <bool X, bool Y, bool Z>
inline void first_two(int n, Stencil s, const float* rhs, float own, float other, float* out) {
#pragma omp simd
  for (int i = 0; i < n; ++i) out[i] = own * rhs[i] + other * neighbours<X, Y, Z>(s, rhs, i);
}

// out = keep * x + back * old + step * (rhs + faces * neighbours); out may be old.
template <bool X, bool Y, bool Z>
inline void sweep(int n, Stencil s, const float* rhs, const float* x, const float* old, float keep,
                  float back, float step, float* out) {
#pragma omp simd
  for (int i = 0; i < n; ++i)
    out[i] = keep * x[i] + back * old[i] + step * (rhs[i] + neighbours<X, Y, Z>(s, x, i));
}

template <bool X, bool Y, bool Z>
inline void sweep_without_old(int n, Stencil s, const float* rhs, const float* x, float keep, float step,
                              float* out) {
#pragma omp simd
  for (int i = 0; i < n; ++i) out[i] = keep * x[i] + step * (rhs[i] + neighbours<X, Y, Z>(s, x, i));
}

// sum (=, or += if `add`) weight * (rhs - A x)
template <bool X, bool Y, bool Z>
inline void weighted_residual(int n, Stencil s, const float* rhs, const float* x, const float* weight,
                              bool add, float* __restrict sum) {
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const float value = weight[i] * (rhs[i] - x[i] + neighbours<X, Y, Z>(s, x, i));
    sum[i] = add ? sum[i] + value : value;
  }
}

// The last sweep of a cycle: the same as sweep, and the scalar product of the answer with rhs, summed in
// double precision: in single it would follow the order of the terms, and CG with it.
template <bool X, bool Y, bool Z>
inline double sweep_and_dot(int n, Stencil s, const float* rhs, const float* x, const float* old, float keep,
                            float back, float step, float* out) {
  double line = 0.0;
#pragma omp simd reduction(+ : line)
  for (int i = 0; i < n; ++i) {
    const float value = keep * x[i] + back * old[i] + step * (rhs[i] + neighbours<X, Y, Z>(s, x, i));
    out[i] = value;
    line += static_cast<double>(value) * static_cast<double>(rhs[i]);  // rhs is 0 in padding
  }
  return line;
}

// out = scale * (given - sum over faces of a (v - v_neighbour)), faces not scaled
template <bool X, bool Y, bool Z>
inline void scaled_difference(int n, Stencil s, const double* given, const float* v, const float* scale,
                              float* out) {
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const float own = v[i];
    float sum = 0.0F;
    if constexpr (X) sum += s.x_face[i] * (own - v[i - 1]) + s.x_face[i + 1] * (own - v[i + 1]);
    if constexpr (Y) sum += s.y_face[i] * (own - v[i - s.sy]) + s.y_face[i + s.sy] * (own - v[i + s.sy]);
    if constexpr (Z) sum += s.z_face[i] * (own - v[i - s.sz]) + s.z_face[i + s.sz] * (own - v[i + s.sz]);
    out[i] = scale[i] * (static_cast<float>(given[i]) - sum);
  }
}

inline double dot(int n, const float* a, const float* b) {
  float line = 0.0F;
#pragma omp simd reduction(+ : line)
  for (int i = 0; i < n; ++i) line += a[i] * b[i];
  return line;
}

}  // namespace granvof::linear::rows
