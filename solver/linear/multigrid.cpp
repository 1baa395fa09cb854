#include "solver/linear/multigrid.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "solver/grid/flush_denormals.hpp"
#include "solver/grid/reduce.hpp"
#include "solver/linear/multigrid_rows.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {
namespace {

constexpr int block = 1024;  // fine values of a row summed or expanded at a time; a multiple of 2 * lanes

rows::Stencil stencil(const std::array<Buffer<float>, 3>& face, const Layout& l) {
  return {face[0].data(), face[1].data(), face[2].data(), l.stride[1], l.stride[2]};
}

}  // namespace

Multigrid::Multigrid(const Layout& layout, const std::array<double, 3>& spacing)
    : user_(layout), spacing_(spacing) {
  // Chebyshev recurrence on [lowest, highest], the eigenvalues of D^-1 A that smoothing is to damp.
  constexpr double lowest = 0.5, highest = 2.0;
  const double centre = 0.5 * (highest + lowest), half = 0.5 * (highest - lowest);
  double rho = half / centre;
  sweeps_[0] = {0.0F, static_cast<float>(1.0 / centre)};
  for (int k = 1; k < max_smoothing; ++k) {
    const double next = 1.0 / (2.0 * centre / half - rho);
    sweeps_[k] = {static_cast<float>(next * rho), static_cast<float>(2.0 * next / half)};
    rho = next;
  }
  build({layout.whole[0] > 1, layout.whole[1] > 1, layout.whole[2] > 1});
}

void Multigrid::smooth(const Level& l, const float* x, const float* old, float old_factor, float* out,
                       Sweep s) const {
  const float keep = 1.0F + s.momentum - s.step, back = -s.momentum * old_factor;
  const rows::Stencil faces = stencil(l.face, l.layout);
  const float* rhs = l.rhs.data();
  const int width = padded(l.layout.n[0]);
  with_directions(l.coupled, [&]<bool X, bool Y, bool Z>() {
    for_each_row(l.layout, [&](int j, int k) {
      const std::ptrdiff_t row = l.layout.index(0, j, k);
      if (old)
        rows::sweep<X, Y, Z>(width, faces.at(row), rhs + row, x + row, old + row, keep, back, s.step,
                             out + row);
      else
        rows::sweep_without_old<X, Y, Z>(width, faces.at(row), rhs + row, x + row, keep, s.step, out + row);
    });
  });
  exchange(l.layout, out);
}

double Multigrid::smooth_and_dot(const Level& l, const float* x, const float* old, float* out,
                                 Sweep s) const {
  const float keep = 1.0F + s.momentum - s.step;
  const rows::Stencil faces = stencil(l.face, l.layout);
  const float* rhs = l.rhs.data();
  // Beyond a seam rhs is not 0, so the product must end with the box.
  const int width = l.layout.any_seam(0) ? l.layout.n[0] : padded(l.layout.n[0]);
  const double dot = with_directions(l.coupled, [&]<bool X, bool Y, bool Z>() {
    return sum_rows(l.layout, [&](int j, int k) {
      const std::ptrdiff_t row = l.layout.index(0, j, k);
      return rows::sweep_and_dot<X, Y, Z>(width, faces.at(row), rhs + row, x + row, (old ? old : x) + row,
                                          keep, old ? -s.momentum : 0.0F, s.step, out + row);
    });
  });
  exchange(l.layout, out);
  return dot;
}

void Multigrid::restrict_residual(const Level& f, const float* x, Level& c) const {
  const rows::Stencil faces = stencil(f.face, f.layout);
  const int width = padded(f.layout.n[0]);
  const int ry = f.coarsened[1] ? 2 : 1, rz = f.coarsened[2] ? 2 : 1;
  with_directions(f.coupled, [&]<bool X, bool Y, bool Z>() {
    for_each_row(c.layout, [&](int j, int k) {
      alignas(64) float sum[block];
      const int ny = std::min(ry, f.layout.n[1] - ry * j), nz = std::min(rz, f.layout.n[2] - rz * k);
      for (int start = 0; start < width; start += block) {
        const int length = std::min(block, width - start);
        for (int b = 0; b < nz; ++b)
          for (int a = 0; a < ny; ++a) {
            const std::ptrdiff_t row = f.layout.index(start, ry * j + a, rz * k + b);
            rows::weighted_residual<X, Y, Z>(length, faces.at(row), f.rhs.data() + row, x + row,
                                             f.weight.data() + row, a + b > 0, sum);
          }
        if (!f.coarsened[0]) {
          std::copy_n(sum, length, c.rhs.data() + c.layout.index(start, j, k));
        } else {  // weights beyond the last cell are 0, so an odd row ends in the right sum
          float* out = c.rhs.data() + c.layout.index(start / 2, j, k);
#pragma omp simd
          for (int i = 0; i < length / 2; ++i) out[i] = sum[2 * i] + sum[2 * i + 1];
        }
      }
    });
  });
  exchange(c.layout, c.rhs.data());
}

void Multigrid::inject(const Level& f, const Level& c, const float* e, float* x) const {
  const int ry = f.coarsened[1] ? 2 : 1, rz = f.coarsened[2] ? 2 : 1;
  const int width = padded(f.layout.n[0]);
  for_each_row(c.layout, [&](int j, int k) {
    alignas(64) float expanded[block];
    const int ny = std::min(ry, f.layout.n[1] - ry * j), nz = std::min(rz, f.layout.n[2] - rz * k);
    for (int start = 0; start < width; start += block) {
      const int length = std::min(block, width - start);
      const float* from = e + c.layout.index(f.coarsened[0] ? start / 2 : start, j, k);
      if (f.coarsened[0]) {
#pragma omp simd
        for (int i = 0; i < length / 2; ++i) expanded[2 * i] = expanded[2 * i + 1] = from[i];
        from = expanded;
      }
      for (int b = 0; b < nz; ++b)
        for (int a = 0; a < ny; ++a) {
          const std::ptrdiff_t row = f.layout.index(start, ry * j + a, rz * k + b);
          float* to = x + row;
          const float* weight = f.weight.data() + row;
#pragma omp simd
          for (int i = 0; i < length; ++i) to[i] += weight[i] * from[i];
        }
    }
  });
  exchange(f.layout, x);
}

// One's own part of what all processes make of the whole level.
float* Multigrid::descend_gathered(Level& l, std::size_t depth, int smoothing, double* dot) {
  Level& whole = levels_[depth + 1];
  l.gathered->collect(l.rhs.data(), whole.rhs.data(), true);
  exchange(whole.layout, whole.rhs.data());
  float* x = l.x[0].data();
  l.gathered->take(descend(depth + 1, smoothing, nullptr), x);
  exchange(l.layout, x);
  const float* r = l.rhs.data();
  if (dot)
    *dot = sum_over(l.layout, Range::all(l.layout),
                    [=](std::ptrdiff_t i) { return static_cast<double>(x[i]) * static_cast<double>(r[i]); });
  return x;
}

float* Multigrid::descend(std::size_t depth, int smoothing, double* dot) {
  Level& l = levels_[depth];
  if (l.gathered) return descend_gathered(l, depth, smoothing, dot);
  float* rhs = l.rhs.data();
  if (depth + 1 == levels_.size()) return rhs;  // the diagonal is all that is left, and it is 1
  float* x = l.x[0].data();
  float* other = l.x[1].data();
  const int width = padded(l.layout.n[0]);

  // From a zero guess the first sweep is a multiple of rhs; only the second needs the faces.
  const float first = sweeps_[0].step;
  const Sweep second = smoothing > 1 ? sweeps_[1] : Sweep{};
  const float own = smoothing > 1 ? first * (1.0F + second.momentum - second.step) + second.step : first;
  const rows::Stencil faces = stencil(l.face, l.layout);
  with_directions(l.coupled, [&]<bool X, bool Y, bool Z>() {
    for_each_row(l.layout, [&](int j, int k) {
      const std::ptrdiff_t row = l.layout.index(0, j, k);
      if (smoothing > 1)
        rows::first_two<X, Y, Z>(width, faces.at(row), rhs + row, own, second.step * first, x + row);
      else
        rows::first_two<false, false, false>(width, faces.at(row), rhs + row, own, 0.0F, x + row);
    });
  });
  exchange(l.layout, x);
  for (int s = 2; s < smoothing; ++s) {
    smooth(l, x, s == 2 ? rhs : other, s == 2 ? first : 1.0F, other, sweeps_[s]);
    std::swap(x, other);
  }

  Level& coarse = levels_[depth + 1];
  restrict_residual(l, x, coarse);
  inject(l, coarse, descend(depth + 1, smoothing, nullptr), x);
  for (int s = 0; s < smoothing; ++s) {
    const float* old = s == 0 ? nullptr : other;
    if (dot && s == smoothing - 1)
      *dot = smooth_and_dot(l, x, old, other, sweeps_[s]);
    else
      smooth(l, x, old, 1.0F, other, sweeps_[s]);
    std::swap(x, other);
  }
  return x;
}

const float* Multigrid::cycle(int smoothing, double* dot) {
  assert(smoothing >= 1 && smoothing <= max_smoothing);
  const FlushDenormals flush;
  exchange(levels_.front().layout, levels_.front().rhs.data());
  if (levels_.size() == 1 && dot) *dot = 0.0;
  float* x = descend(0, smoothing, dot);
  if (levels_.size() == 1 && dot) {
    const Layout& l = levels_.front().layout;
    *dot = sum_rows(l, [&](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      return rows::dot(l.n[0], x + row, x + row);
    });
  }
  return x;
}

namespace {

template <typename T>
void apply_in(Multigrid& mg, const Layout& user, const T* r, T* z, int smoothing) {
  const Layout& l = mg.layout();
  const int n = l.n[0];
  const float* scale = mg.scale();
  float* rhs = mg.residual();
  for_each_row(l, [&](int j, int k) {
    const std::ptrdiff_t from = user.index(0, j, k), to = l.index(0, j, k);
#pragma omp simd
    for (int i = 0; i < n; ++i) rhs[to + i] = scale[to + i] * static_cast<float>(r[from + i]);
  });
  const float* x = mg.cycle(smoothing);
  for_each_row(l, [&](int j, int k) {
    const std::ptrdiff_t to = user.index(0, j, k), from = l.index(0, j, k);
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const float s = scale[from + i];
      z[to + i] = s > 0.0F ? static_cast<T>(s * x[from + i]) : r[to + i];
    }
  });
}

}  // namespace

void Multigrid::apply(const float* r, float* z, int smoothing) {
  apply_in(*this, user_, r, z, smoothing);
}
void Multigrid::apply(const double* r, double* z, int smoothing) {
  apply_in(*this, user_, r, z, smoothing);
}

}  // namespace granvof::linear
