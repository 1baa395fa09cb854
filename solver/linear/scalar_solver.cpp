#include "solver/linear/scalar_solver.hpp"

#include <algorithm>
#include <cmath>

#include "solver/grid/flush_denormals.hpp"
#include "solver/grid/reduce.hpp"
#include "solver/linear/face_operator.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {

namespace {

// 1 / x, rounded to a power of two: multiplying by it loses nothing. 1 for 0.
double power_of_two_near(double x) {
  return x > 0.0 ? std::ldexp(1.0, -std::ilogb(x)) : 1.0;
}

}  // namespace

ScalarSolver::ScalarSolver(const Layout& layout, const std::array<double, 3>& spacing, int smoothing)
    : user_(layout),
      smoothing_(smoothing),
      multigrid_(layout, spacing),
      layout_(multigrid_.layout()),
      zeros_(static_cast<std::size_t>(padded(layout.n[0]))),
      r_(layout_.size),
      q_(layout_.size),
      guess_(layout_.size),
      p_(layout_.size) {}

Report ScalarSolver::solve(const Faces& faces, const double* mass, const double* rhs, double* x,
                           const Tolerance& tolerance) {
  for (int d = 0; d < 3; ++d) coupled_[d] = faces.lower[d] != nullptr && user_.whole[d] > 1;
  Report report;
  report.initial = report.final = true_residual(faces, mass, rhs, x);
  if (!std::isfinite(report.initial)) return report;
  const double target = std::max(tolerance.absolute, tolerance.relative * report.initial);
  report.converged = report.initial <= target;
  if (report.converged || tolerance.max_iterations <= 0) return report;

  multigrid_.set(faces, mass);
  double start = report.initial;  // true residual at the last (re)start
  double norm = start, rz = 0.0;
  bool fresh = true;
  for (;;) {
    if (fresh) {
      unit_ = power_of_two_near(start);
      scale_residual();
    }
    double previous = rz;
    const float* z = multigrid_.cycle(smoothing_, &rz);
    ++report.iterations;
    combine(z, fresh ? 0.0 : rz / previous);
    fresh = false;
    const double pq = multiply(faces, mass);
    const bool broken = !(pq > 0.0) || !std::isfinite(pq) || !std::isfinite(rz);
    if (!broken) norm = advance(rz / pq / unit_, x);
    if (!broken && norm > target && std::isfinite(norm) && report.iterations < tolerance.max_iterations)
      continue;

    report.final = true_residual(faces, mass, rhs, x);
    report.converged = report.final <= target;
    // Rounding makes the recurrence drift from the true residual; go on from the latter while that helps.
    const bool useful = std::isfinite(report.final) && report.final < 0.5 * start;
    if (report.converged || report.iterations >= tolerance.max_iterations || !useful) return report;
    start = report.final;
    fresh = true;
  }
}

// r = rhs - A x; its largest value.
double ScalarSolver::true_residual(const Faces& faces, const double* mass, const double* rhs,
                                   const double* x) {
  double* guess = guess_.data();
  const int n = user_.n[0];
  for_each_row(layout_, [&](int j, int k) {
    std::copy_n(x + user_.index(0, j, k), n, guess + layout_.index(0, j, k));
  });
  exchange(layout_, guess);
  const std::ptrdiff_t sy = layout_.stride[1], sz = layout_.stride[2];
  return with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    return max_rows(layout_, [&](int j, int k) {
      const std::ptrdiff_t here = layout_.index(0, j, k), given = user_.index(0, j, k);
      const double *v = guess + here, *m = mass + given, *b = rhs + given;
      double* r = r_.data() + here;
      rows::face_sums<X, Y, Z>(n, rows::face_row(faces.lower, user_, j, k, zeros_.data()), v, sy, sz,
                               [=](int i, double sum) { r[i] = b[i] - (m[i] * v[i] + sum); });
      double line = 0.0, poison = 0.0;
#pragma omp simd reduction(max : line) reduction(+ : poison)
      for (int i = 0; i < n; ++i) {
        line = std::max(line, std::fabs(r[i]));
        poison += 0.0 * r[i];
      }
      return line + poison;
    });
  });
}

// q = A p, both per unit; returns p . q.
double ScalarSolver::multiply(const Faces& faces, const double* mass) {
  exchange(layout_, p_.data());
  const std::ptrdiff_t sy = layout_.stride[1], sz = layout_.stride[2];
  const int n = user_.n[0];
  return with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    return sum_rows(layout_, [&](int j, int k) {
      const std::ptrdiff_t here = layout_.index(0, j, k), given = user_.index(0, j, k);
      const double* m = mass + given;
      const float* p = p_.data() + here;
      double* q = q_.data() + here;
      rows::face_sums<X, Y, Z>(n, rows::face_row(faces.lower, user_, j, k, zeros_.data()), p, sy, sz,
                               [=](int i, double sum) { q[i] = m[i] * p[i] + sum; });
      double line = 0.0;
#pragma omp simd reduction(+ : line)
      for (int i = 0; i < n; ++i) line += p[i] * q[i];
      return line;
    });
  });
}

// p = z + beta p, where z comes scaled from multigrid.
void ScalarSolver::combine(const float* z, double beta) {
  const FlushDenormals flush;
  const auto b = static_cast<float>(beta);
  const int width = padded(layout_.n[0]);
  for_each_row(layout_, [&](int j, int k) {
    const std::ptrdiff_t row = layout_.index(0, j, k);
    float* p = p_.data() + row;
    const float *s = multigrid_.scale() + row, *from = z + row;
    if (b == 0.0F) {
#pragma omp simd
      for (int i = 0; i < width; ++i) p[i] = s[i] * from[i];
    } else {
#pragma omp simd
      for (int i = 0; i < width; ++i) p[i] = s[i] * from[i] + b * p[i];
    }
  });
}

// x += alpha p, r -= alpha q (alpha per unit), and the new residual scaled for multigrid; the largest value
// of r.
double ScalarSolver::advance(double alpha, double* x) {
  const int n = user_.n[0];
  const double unit = unit_;
  return max_rows(layout_, [&](int j, int k) {
    const std::ptrdiff_t here = layout_.index(0, j, k);
    const float *p = p_.data() + here, *s = multigrid_.scale() + here;
    const double* q = q_.data() + here;
    double *r = r_.data() + here, *to = x + user_.index(0, j, k);
    float* scaled = multigrid_.residual() + here;
    double line = 0.0, poison = 0.0;
#pragma omp simd reduction(max : line) reduction(+ : poison)
    for (int i = 0; i < n; ++i) {
      to[i] += alpha * p[i];
      const double v = r[i] - alpha * q[i];
      r[i] = v;
      scaled[i] = s[i] * static_cast<float>(unit * v);
      line = std::max(line, std::fabs(v));
      poison += 0.0 * v;
    }
    return line + poison;
  });
}

void ScalarSolver::scale_residual() {
  const int n = user_.n[0];
  const double unit = unit_;
  for_each_row(layout_, [&](int j, int k) {
    const std::ptrdiff_t row = layout_.index(0, j, k);
    const float* s = multigrid_.scale() + row;
    const double* r = r_.data() + row;
    float* scaled = multigrid_.residual() + row;
#pragma omp simd
    for (int i = 0; i < n; ++i) scaled[i] = s[i] * static_cast<float>(unit * r[i]);
  });
}

}  // namespace granvof::linear
