// Preconditioned conjugate gradients in double precision over one to three components, each with its own
// layout.
//
// The operator and the preconditioner are given as functions, so that a tensor operator over the velocity
// components of faces takes the same solver as a scalar one over cells.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "solver/grid/for_each.hpp"
#include "solver/grid/layout.hpp"
#include "solver/grid/memory.hpp"
#include "solver/grid/reduce.hpp"
#include "solver/linear/padded_layout.hpp"
#include "solver/linear/tolerance.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {

using Components = std::array<double*, 3>;  // nullptr beyond the number of components
using ConstComponents = std::array<const double*, 3>;

// Body for rows: the largest |body(index)| weight[index] of one, nullptr for weights of 1; not finite if
// one of them is not.
template <typename Body>
auto largest_of_row(const Layout& l, const double* weight, Body body) {
  return [l, weight, body](int j, int k) {
    const std::ptrdiff_t row = l.index(0, j, k);
    const int n = l.n[0];
    double line = 0.0, poison = 0.0;  // 0 * v is 0 unless v is not finite
    const auto take = [&](double v) {
      line = v > line ? v : line;
      poison += 0.0 * v;
    };
    if (weight == nullptr) {
#pragma omp simd reduction(max : line) reduction(+ : poison)
      for (int i = 0; i < n; ++i) take(std::fabs(body(row + i)));
    } else {
#pragma omp simd reduction(max : line) reduction(+ : poison)
      for (int i = 0; i < n; ++i) take(std::fabs(body(row + i) * weight[row + i]));
    }
    return line + poison;
  };
}

class ConjugateGradient {
 public:
  // One layout per component (1 to 3), of boxes that the same processes share.
  explicit ConjugateGradient(const std::vector<Layout>& layouts) : layouts_(layouts) {
    assert(!layouts.empty() && layouts.size() <= 3);
    for (std::size_t c = 0; c < layouts_.size(); ++c) {
      for (auto* set : {&r_, &z_, &p_, &q_}) {
        buffers_.emplace_back(layouts_[c].size);
        (*set)[c] = buffers_.back().data();
      }
    }
  }

  // Other boxes in the same memory.
  void fit(const std::vector<Layout>& layouts) {
    layouts_ = layouts;
    for (std::size_t c = 0; c < layouts_.size(); ++c) std::fill_n(p_[c], layouts_[c].size, 0.0);
  }

  // Solves A x = rhs for a symmetric positive (semi-)definite A, from x = 0.
  //   apply(const Components& p, const Components& q): q = A p on the boxes. Ghosts of p are 0 unless apply
  //   fills
  //     them (it may write them: that is where exchange belongs). p and q never alias.
  //   precondition(const ConstComponents& r, const Components& z): z = M r on the boxes, M symmetric and
  //   positive
  //     definite, for example one Multigrid::apply per component.
  // Ghosts of x and rhs are neither read nor written. With `weight` the residual is judged, and reported, row
  // by row times its weight (>= 0); the iteration itself does not change.
  template <typename Apply, typename Precondition>
  Report solve(Apply&& apply, Precondition&& precondition, const ConstComponents& rhs, const Components& x,
               const Tolerance& tolerance, const ConstComponents& weight = {}) {
    Report report;
    report.initial = report.final = residual_at_zero(rhs, x, weight);
    if (!std::isfinite(report.initial)) return report;
    const double target = std::max(tolerance.absolute, tolerance.relative * report.initial);
    double restart_norm = report.initial;  // the true residual at the last (re)start
    bool fresh = true;
    double rz = 0.0;
    double norm = report.initial;
    for (;;) {
      if (norm <= target || !std::isfinite(norm) || report.iterations >= tolerance.max_iterations) {
        if (report.iterations > 0) report.final = true_residual(apply, rhs, x, weight);
        report.converged = report.final <= target;
        // Rounding makes the recurrence drift from the true residual; go on from the latter while that helps.
        const bool useful = std::isfinite(report.final) && report.final < 0.5 * restart_norm;
        if (report.converged || report.iterations >= tolerance.max_iterations || !useful) return report;
        restart_norm = report.final;
        fresh = true;
      }
      precondition(as_const(r_), z_);
      ++report.iterations;
      const double previous = rz;
      rz = dot(r_, z_);
      combine(fresh ? 0.0 : rz / previous);  // p = z + beta p
      fresh = false;
      apply(p_, q_);
      const double pq = dot(p_, q_);
      if (!(pq > 0.0) || !std::isfinite(pq) || !std::isfinite(rz)) {  // breakdown
        report.final = true_residual(apply, rhs, x, weight);
        report.converged = report.final <= target;
        return report;
      }
      norm = advance(rz / pq, x, weight);
    }
  }

 private:
  static ConstComponents as_const(const Components& c) { return {c[0], c[1], c[2]}; }

  // x = 0 and r = rhs; its largest value, weighted.
  double residual_at_zero(const ConstComponents& rhs, const Components& x, const ConstComponents& weight) {
    return max_rows(layouts_, [&](std::size_t c) {
      const double* b = rhs[c];
      double *r = r_[c], *to = x[c];
      return largest_of_row(layouts_[c], weight[c], [=](std::ptrdiff_t i) {
        to[i] = 0.0;
        return r[i] = b[i];
      });
    });
  }

  // r = rhs - A x; its largest value, weighted. Uses p and q as scratch.
  template <typename Apply>
  double true_residual(Apply& apply, const ConstComponents& rhs, const Components& x,
                       const ConstComponents& weight) {
    for (std::size_t c = 0; c < layouts_.size(); ++c) {
      double* p = p_[c];
      const double* from = x[c];
      for_each(layouts_[c], [=](std::ptrdiff_t i) { p[i] = from[i]; });
    }
    apply(p_, q_);
    return max_rows(layouts_, [&](std::size_t c) {
      const double *q = q_[c], *b = rhs[c];
      double* r = r_[c];
      return largest_of_row(layouts_[c], weight[c], [=](std::ptrdiff_t i) { return r[i] = b[i] - q[i]; });
    });
  }

  double dot(const Components& a, const Components& b) const {
    return sum_over(layouts_, [&](std::size_t c) {
      const double *u = a[c], *v = b[c];
      return [=](std::ptrdiff_t i) { return u[i] * v[i]; };
    });
  }

  void combine(double beta) {
    for (std::size_t c = 0; c < layouts_.size(); ++c) {
      double* p = p_[c];
      const double* z = z_[c];
      if (beta == 0.0)
        for_each(layouts_[c], [=](std::ptrdiff_t i) { p[i] = z[i]; });
      else
        for_each(layouts_[c], [=](std::ptrdiff_t i) { p[i] = z[i] + beta * p[i]; });
    }
  }

  // x += alpha p, r -= alpha q; the largest value of r, weighted.
  double advance(double alpha, const Components& x, const ConstComponents& weight) {
    return max_rows(layouts_, [&](std::size_t c) {
      const double *p = p_[c], *q = q_[c];
      double *to = x[c], *r = r_[c];
      return largest_of_row(layouts_[c], weight[c], [=](std::ptrdiff_t i) {
        to[i] += alpha * p[i];
        return r[i] -= alpha * q[i];
      });
    });
  }

  std::vector<Layout> layouts_;
  std::vector<Buffer<double>> buffers_;
  Components r_{}, z_{}, p_{}, q_{};
};

}  // namespace granvof::linear
