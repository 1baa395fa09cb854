// The preconditioner of CoupledSolver, as its header describes it.
#include "solver/grid/flush_denormals.hpp"
#include "solver/grid/reduce.hpp"
#include "solver/linear/coupled_solver.hpp"
#include "solver/linear/face_operator.hpp"
#include "solver/linear/multigrid_rows.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {
namespace {

constexpr int pressure_smoothing = 3, granular_smoothing = 2;

// Rows of max(0, k22 - k21 k12 / k11) and m22.
class SchurComplement final : public Coefficients {
 public:
  SchurComplement(const Layout& l, const CoupledSystem& s) : layout_(l), s_(s) {}
  bool coupled(int d) const override { return s_.k22[d] != nullptr; }
  void faces(int d, int j, int k, float* out) const override {
    const std::ptrdiff_t row = layout_.index(0, j, k);
    const double *a = s_.k11[d] + row, *b = s_.k12[d] + row, *c = s_.k21[d] + row, *e = s_.k22[d] + row;
    const int n = layout_.n[0];
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const double divisor = a[i] > 0.0 ? a[i] : 1.0;
      const double shared = a[i] > 0.0 ? c[i] * b[i] : 0.0;
      const double left = e[i] - shared / divisor;
      out[i] = static_cast<float>(left > 0.0 ? left : 0.0);
    }
  }
  void masses(int j, int k, float* out) const override {
    const double* row = s_.m22 + layout_.index(0, j, k);
    const int n = layout_.n[0];
#pragma omp simd
    for (int i = 0; i < n; ++i) out[i] = static_cast<float>(row[i]);
  }

 private:
  const Layout& layout_;
  const CoupledSystem& s_;
};

}  // namespace

void CoupledSolver::set(const CoupledSystem& s) {
  pressure_.set(Faces{s.k11}, s.m11);
  if (is_empty(part_)) return;
  granular_->set(SchurComplement(given_[1], s));
  const Layout& all = layout_[0];
  for (int d = 0; d < 3; ++d) {
    if (!coupled_[d]) continue;
    float* to = k21_[d].data();
    Range faces = part_;
    if (faces.upper[d] < user_.n[d]) ++faces.upper[d];
    const int n = faces.upper[0] - faces.lower[0];
    for_each_row(faces, [&](int j, int k) {
      float* row = to + all.index(faces.lower[0], j, k);
      const double* from = s.k21[d] + user_.index(faces.lower[0], j, k);
#pragma omp simd
      for (int i = 0; i < n; ++i) row[i] = static_cast<float>(from[i]);
    });
    exchange(all, to);
  }
  with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    for_each_row(layout_[1], [&](int j, int k) {
      const int n = given_[1].n[0];
      const rows::FaceRow a =
          rows::face_row(s.k11, user_, part_.lower[1] + j, part_.lower[2] + k, zeros_.data())
              .from(part_.lower[0], n);
      const rows::FaceRow b = rows::face_row(s.k12, given_[1], j, k, zeros_.data());
      float* theta = theta_.data() + layout_[1].index(0, j, k);
      const auto store = [=](int i, double above, double below) {
        theta[i] = static_cast<float>((below > 0.0 ? above : 0.0) / (below > 0.0 ? below : 1.0));
      };
      const auto total = [](const rows::FaceRow& f, double x_upper, int i) {
        double sum = 0.0;
        if constexpr (X) sum += f.x[i] + x_upper;
        if constexpr (Y) sum += f.y[i] + f.y_upper[i];
        if constexpr (Z) sum += f.z[i] + f.z_upper[i];
        return sum;
      };
      const int inner = X ? n - 1 : n;
#pragma omp simd
      for (int i = 0; i < inner; ++i)
        store(i, total(b, X ? b.x[i + 1] : 0.0, i), total(a, X ? a.x[i + 1] : 0.0, i));
      if constexpr (X) store(n - 1, total(b, b.x_end, n - 1), total(a, a.x_end, n - 1));
    });
  });
}

void CoupledSolver::precondition(const Pair& from, FloatPair& to) {
  const Layout& l = layout_[0];
  const int n = l.n[0], width = padded(n);
  const float* scale = pressure_.scale();
  float* rhs = pressure_.residual();
  const double* r = from[0].data();
  float* y = to[0].data();
  for_each_row(l, [&](int j, int k) {
    const std::ptrdiff_t row = l.index(0, j, k);
#pragma omp simd
    for (std::ptrdiff_t i = row; i < row + n; ++i) rhs[i] = scale[i] * static_cast<float>(r[i]);
  });
  const float* p = pressure_.cycle(pressure_smoothing);
  const FlushDenormals flush;
  for_each_row(l, [&](int j, int k) {
    const std::ptrdiff_t row = l.index(0, j, k);
#pragma omp simd
    for (std::ptrdiff_t i = row; i < row + width; ++i) y[i] = scale[i] * p[i];
  });
  if (!is_empty(part_)) precondition_second(from[1].data(), to);
}

// y2 = S (r2 - K21 y1);  y1 -= theta y2
void CoupledSolver::precondition_second(const double* r2, FloatPair& to) {
  const Layout &all = layout_[0], &l = layout_[1];
  float *y1 = to[0].data(), *y2 = to[1].data();
  exchange(all, y1);
  const float* scale = granular_->scale();
  float* rhs = granular_->residual();
  const rows::Stencil k21{k21_[0].data(), k21_[1].data(), k21_[2].data(), all.stride[1], all.stride[2]};
  // The scale of padding is 0; what is read beside it need not be, and beyond a seam is none.
  const int n = l.n[0], width = padded(n), length = l.any_seam(0) ? n : width;
  const auto of_all = [&](int j, int k) {
    return all.index(part_.lower[0], part_.lower[1] + j, part_.lower[2] + k);
  };
  with_directions(coupled_, [&]<bool X, bool Y, bool Z>() {
    for_each_row(l, [&](int j, int k) {
      const std::ptrdiff_t row = l.index(0, j, k), first = of_all(j, k);
      rows::scaled_difference<X, Y, Z>(length, k21.at(first), r2 + row, y1 + first, scale + row, rhs + row);
    });
  });
  const float* g = granular_->cycle(granular_smoothing);
  const float* theta = theta_.data();
  for_each_row(l, [&](int j, int k) {
    const std::ptrdiff_t row = l.index(0, j, k);
    float* first = y1 + of_all(j, k);
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const float v = scale[row + i] * g[row + i];
      y2[row + i] = v;
      first[i] -= theta[row + i] * v;
    }
  });
}

}  // namespace granvof::linear
