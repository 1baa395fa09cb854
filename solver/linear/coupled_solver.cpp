#include "solver/linear/coupled_solver.hpp"

#include <algorithm>
#include <cmath>

#include "solver/grid/reduce.hpp"
#include "solver/linear/face_operator.hpp"
#include "solver/linear/multigrid_rows.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {
namespace {

// Largest |values|; not finite if one of them is not.
double largest(int n, const double* values) {
  double line = 0.0, poison = 0.0;
#pragma omp simd reduction(max : line) reduction(+ : poison)
  for (int i = 0; i < n; ++i) {
    line = std::max(line, std::fabs(values[i]));
    poison += 0.0 * values[i];
  }
  return line + poison;
}

}  // namespace

bool CoupledSolver::Norms::finite() const {
  return std::isfinite(first) && std::isfinite(second);
}

CoupledSolver::CoupledSolver(const Layout& layout, const std::array<double, 3>& spacing)
    : user_(layout),
      spacing_(spacing),
      pressure_(layout, spacing),
      given_{layout, part_of(layout, part_)},
      layout_{pressure_.layout(), given_[1]},
      zeros_(static_cast<std::size_t>(padded(layout.n[0]))) {
  for (auto& face : k21_) face = Buffer<float>(layout_[0].size);
  for (Pair* pair : {&r_, &shadow_, &p_, &v_, &t_}) (*pair)[0] = Buffer<double>(layout_[0].size);
  for (FloatPair* pair : {&y_, &w_}) (*pair)[0] = Buffer<float>(layout_[0].size);
}

// What belongs to the second row alone is kept on its part.
void CoupledSolver::fit(const Range& second) {
  if (second == part_) return;
  part_ = second;
  given_[1] = part_of(user_, part_);
  granular_.reset();
  std::size_t size = 0;
  if (!is_empty(part_)) {
    granular_.emplace(given_[1], spacing_);
    layout_[1] = granular_->layout();
    size = layout_[1].size;
  } else {
    layout_[1] = given_[1];
  }
  theta_.assign(size, 0.0F);
  for (Pair* pair : {&r_, &shadow_, &p_, &v_, &t_}) (*pair)[1].assign(size, 0.0);
  for (FloatPair* pair : {&y_, &w_}) (*pair)[1].assign(size, 0.0F);
}

Report CoupledSolver::solve(const CoupledSystem& system, double* x1, double* x2, const Tolerance& tolerance) {
  for (int d = 0; d < 3; ++d) coupled_[d] = system.k11[d] != nullptr && user_.whole[d] > 1;
  fit(system.second.value_or(Range::all(user_)));
  const Norms initial = true_residual(system, x1, x2);
  Report report;
  report.initial = report.final = initial.larger();
  if (!initial.finite()) return report;
  const Norms target{std::max(tolerance.absolute, tolerance.relative * initial.first),
                     std::max(tolerance.absolute, tolerance.relative * initial.second)};
  report.converged = initial.below(target);
  if (report.converged || tolerance.max_iterations <= 0) return report;
  // One measure of how far both rows are from their targets, to judge restarts by.
  const auto excess = [&](const Norms& n) {
    const double tiny = 1e-300;
    return std::max(n.first / std::max(target.first, tiny), n.second / std::max(target.second, tiny));
  };

  set(system);
  double start = excess(initial);
  int useless_restarts = 0;
  bool fresh = true;
  double rho = 0.0, alpha = 0.0, omega = 0.0;
  for (;;) {
    bool stop = false;  // converged, broken down or out of iterations: look at the true residual
    if (fresh) {
      for (int c = 0; c < 2; ++c) std::copy(r_[c].begin(), r_[c].end(), shadow_[c].begin());
      rho = first_direction();
      fresh = false;
    } else {
      const double previous = rho;
      rho = dot(shadow_, r_);
      direction((rho / previous) * (alpha / omega), omega);
    }
    if (rho == 0.0 || !std::isfinite(rho)) stop = true;

    if (!stop) {
      precondition(p_, y_);
      ++report.iterations;
      const double shadow_v = multiply(system, y_, v_, shadow_).with;
      alpha = rho / shadow_v;
      if (shadow_v == 0.0 || !std::isfinite(alpha)) stop = true;
    }
    if (!stop) {
      const Norms half = subtract(alpha, v_);
      if (half.below(target) || !half.finite() || report.iterations >= tolerance.max_iterations) {
        advance(alpha, 0.0, x1, x2);
        stop = true;
      }
    }
    if (!stop) {
      precondition(r_, w_);
      ++report.iterations;
      const Products p = multiply(system, w_, t_, r_);
      omega = p.self > 0.0 ? p.with / p.self : 0.0;
      if (!std::isfinite(omega)) omega = 0.0;
      advance(alpha, omega, x1, x2);
      const Norms norms = subtract(omega, t_);
      stop = omega == 0.0 || norms.below(target) || !norms.finite() ||
             report.iterations >= tolerance.max_iterations;
    }
    if (!stop) continue;

    const Norms now = true_residual(system, x1, x2);
    report.final = now.larger();
    report.converged = now.below(target);
    // Rounding or a breakdown: restart from the true residual, but not for ever without progress.
    const double left = excess(now);
    useless_restarts = left < 0.5 * start ? 0 : useless_restarts + 1;
    if (report.converged || report.iterations >= tolerance.max_iterations || !now.finite() ||
        useless_restarts > 1)
      return report;
    start = left;
    fresh = true;
  }
}

bool CoupledSolver::has_second(int j, int k) const {
  return j >= part_.lower[1] && j < part_.upper[1] && k >= part_.lower[2] && k < part_.upper[2] &&
         part_.upper[0] > part_.lower[0];
}

// One row of the matrix times (v1, v2); block by block, as fewer streams suit the registers better.
template <bool X, bool Y, bool Z, typename T>
void CoupledSolver::product_row(const CoupledSystem& s, const T* v1, const T* v2, int j, int k, double* out1,
                                double* out2) {
  const auto sums = [](const Layout& l, const rows::FaceRow& faces, const T* v, auto&& store) {
    rows::face_sums<X, Y, Z>(l.n[0], faces, v, l.stride[1], l.stride[2], store);
  };
  const std::ptrdiff_t first = layout_[0].index(0, j, k);
  {
    const double* mass = s.m11 + user_.index(0, j, k);
    const T* own = v1 + first;
    double* out = out1 + first;
    sums(layout_[0], rows::face_row(s.k11, user_, j, k, zeros_.data()), own,
         [=](int i, double sum) { out[i] = mass[i] * own[i] + sum; });
  }
  if (!has_second(j, k)) return;
  const int at = part_.lower[0], n = given_[1].n[0];
  const std::array<int, 3> here{0, j - part_.lower[1], k - part_.lower[2]};
  const std::ptrdiff_t second = layout_[1].index(here);
  {
    double* out = out1 + first + at;
    sums(layout_[1], rows::face_row(s.k12, given_[1], here[1], here[2], zeros_.data()), v2 + second,
         [=](int i, double sum) { out[i] += sum; });
  }
  const double* mass = s.m22 + given_[1].index(here);
  const T* own = v2 + second;
  double* out = out2 + second;
  // The first row's values go on beyond the part.
  const rows::FaceRow faces = rows::face_row(s.k21, user_, j, k, zeros_.data()).from(at, n);
  rows::face_sums<X, Y, Z>(n, faces, v1 + first + at, layout_[0].stride[1], layout_[0].stride[2],
                           [=](int i, double sum) { out[i] = sum; });
  // The mass last: where P_s answers to nothing it outweighs all else, and what is added to it is lost.
  sums(layout_[1], rows::face_row(s.k22, given_[1], here[1], here[2], zeros_.data()), own,
       [=](int i, double sum) { out[i] = mass[i] * own[i] + (out[i] + sum); });
}

CoupledSolver::Norms CoupledSolver::true_residual(const CoupledSystem& s, const double* x1,
                                                  const double* x2) {
  const std::array<const double*, 2> x{x1, x2}, rhs{s.rhs1, s.rhs2};
  for (int c = 0; c < 2; ++c) {
    const Layout &l = layout_[c], &given = given_[c];
    double* to = t_[c].data();
    for_each_row(
        l, [&](int j, int k) { std::copy_n(x[c] + given.index(0, j, k), l.n[0], to + l.index(0, j, k)); });
    if (!is_empty(Range::all(l))) exchange(l, to);
  }
  with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    for_each_row(layout_[0], [&](int j, int k) {
      product_row<X, Y, Z>(s, t_[0].data(), t_[1].data(), j, k, r_[0].data(), r_[1].data());
    });
  });
  Norms norms;
  for (int c = 0; c < 2; ++c) {
    const Layout &l = layout_[c], &given = given_[c];
    (c == 0 ? norms.first : norms.second) = max_rows(l, [&](int j, int k) {
      const int n = l.n[0];
      double* r = r_[c].data() + l.index(0, j, k);
      const double* b = rhs[c] + given.index(0, j, k);
#pragma omp simd
      for (int i = 0; i < n; ++i) r[i] = b[i] - r[i];
      return largest(n, r);
    });
    // t is reused as a product later: nothing but the box may stay in it
    if (l.any_seam()) std::fill(t_[c].begin(), t_[c].end(), 0.0);
  }
  return norms;
}

// out = A v and its products.
CoupledSolver::Products CoupledSolver::multiply(const CoupledSystem& s, FloatPair& v, Pair& out,
                                                const Pair& with) {
  exchange(layout_[0], v[0].data());
  if (!is_empty(part_)) exchange(layout_[1], v[1].data());
  const auto products = with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    return sum_rows(layout_[0], [&](int j, int k) {
      product_row<X, Y, Z>(s, v[0].data(), v[1].data(), j, k, out[0].data(), out[1].data());
      double a = 0.0, b = 0.0;
      const auto add = [&](int c, std::ptrdiff_t row) {
        const int n = layout_[c].n[0];
        const double *o = out[c].data() + row, *w = with[c].data() + row;
#pragma omp simd reduction(+ : a, b)
        for (int i = 0; i < n; ++i) {
          a += o[i] * w[i];
          b += o[i] * o[i];
        }
      };
      add(0, layout_[0].index(0, j, k));
      if (has_second(j, k)) add(1, layout_[1].index(0, j - part_.lower[1], k - part_.lower[2]));
      return Sums<2>{{a, b}};
    });
  });
  return {products.values[0], products.values[1]};
}

double CoupledSolver::dot(const Pair& first, const Pair& second) const {
  return sum_rows(layout_, [&](std::size_t c) {
    const double *a = first[c].data(), *b = second[c].data();
    return [=, &l = layout_[c]](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      const int n = l.n[0];
      double line = 0.0;
#pragma omp simd reduction(+ : line)
      for (int i = 0; i < n; ++i) line += a[row + i] * b[row + i];
      return line;
    };
  });
}

// r -= factor what; the largest values of r.
CoupledSolver::Norms CoupledSolver::subtract(double factor, const Pair& what) {
  Norms norms;
  for (int c = 0; c < 2; ++c) {
    const Layout& l = layout_[c];
    (c == 0 ? norms.first : norms.second) = max_rows(l, [&](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      const int n = l.n[0];
      double* r = r_[c].data() + row;
      const double* w = what[c].data() + row;
      double line = 0.0, poison = 0.0;
#pragma omp simd reduction(max : line) reduction(+ : poison)
      for (int i = 0; i < n; ++i) {
        r[i] -= factor * w[i];
        line = std::max(line, std::fabs(r[i]));
        poison += 0.0 * r[i];
      }
      return line + poison;
    });
  }
  return norms;
}

// x += alpha y + omega w
void CoupledSolver::advance(double alpha, double omega, double* x1, double* x2) {
  for (int c = 0; c < 2; ++c) {
    const Layout &l = layout_[c], &given = given_[c];
    double* x = c == 0 ? x1 : x2;
    for_each_row(l, [&](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      const int n = l.n[0];
      double* to = x + given.index(0, j, k);
      const float *y = y_[c].data() + row, *w = w_[c].data() + row;
      if (omega == 0.0) {
#pragma omp simd
        for (int i = 0; i < n; ++i) to[i] += alpha * y[i];
      } else {
#pragma omp simd
        for (int i = 0; i < n; ++i) to[i] += alpha * y[i] + omega * w[i];
      }
    });
  }
}

// p = r, at a start; returns r . r.
double CoupledSolver::first_direction() {
  return sum_rows(layout_, [&](std::size_t c) {
    double* to = p_[c].data();
    const double* from = r_[c].data();
    return [=, &l = layout_[c]](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      const int n = l.n[0];
      double* p = to + row;
      const double* r = from + row;
      double line = 0.0;
#pragma omp simd reduction(+ : line)
      for (int i = 0; i < n; ++i) {
        p[i] = r[i];
        line += r[i] * r[i];
      }
      return line;
    };
  });
}

// p = r + beta (p - omega v)
void CoupledSolver::direction(double beta, double omega) {
  for (int c = 0; c < 2; ++c) {
    const Layout& l = layout_[c];
    for_each_row(l, [&](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k);
      const int n = l.n[0];
      double* p = p_[c].data() + row;
      const double *r = r_[c].data() + row, *v = v_[c].data() + row;
#pragma omp simd
      for (int i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    });
  }
}

}  // namespace granvof::linear
