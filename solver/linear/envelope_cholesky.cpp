#include "solver/linear/envelope_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace granvof::linear {
namespace {

constexpr std::size_t values_of_cache_line = 8;

}  // namespace

void EnvelopeCholesky::reset(const std::vector<int>& first) {
  size_ = static_cast<int>(first.size());
  panels_.assign(static_cast<std::size_t>((size_ + width - 1) / width), Panel{});
  for (int i = 0; i < size_; ++i) {
    Panel& panel = panels_[static_cast<std::size_t>(first[i] / width)];
    panel.rows = std::max(panel.rows, i + 1 - first[i] / width * width);
  }
  std::size_t end = 0;
  int reached = width;
  for (Panel& panel : panels_) {
    // What a panel reaches those to its right fill as well.
    panel.rows = std::max(panel.rows, reached);
    reached = std::max(panel.rows - width, width);
    panel.begin = end;
    panel.stride = (static_cast<std::size_t>(panel.rows) + values_of_cache_line - 1) / values_of_cache_line *
                   values_of_cache_line;
    end += width * panel.stride;
  }
  values_.assign(end, 0.0);
  // The last panel's columns beyond the matrix: those of the identity.
  for (int i = size_; i % width != 0; ++i)
    values_[panels_.back().begin + i % width * (panels_.back().stride + 1)] = 1.0;
}

// A panel, its columns to the left being taken off already.
bool EnvelopeCholesky::factorise(const Panel& panel) {
  double* const columns = values_.data() + panel.begin;
  for (int c = 0; c < width; ++c) {
    double* const column = columns + c * panel.stride;
    for (int p = 0; p < c; ++p) {
      const double* const left = columns + p * panel.stride;
      const double factor = left[c];
#pragma omp simd
      for (int i = c; i < panel.rows; ++i) column[i] -= factor * left[i];
    }
    if (!(column[c] > 0.0)) return false;
    const double root = std::sqrt(column[c]), inverse = 1.0 / root;
    column[c] = root;
#pragma omp simd
    for (int i = c + 1; i < panel.rows; ++i) column[i] *= inverse;
  }
  return true;
}

// Takes a panel off one to its right: `rows`, the panel's values from the other's first row on, `length` of
// them.
void EnvelopeCholesky::take_off(const Panel& panel, const double* rows, int length, const Panel& right) {
  double factor[width][width];
  for (int c = 0; c < width; ++c)
    for (int p = 0; p < width; ++p) factor[c][p] = c < length ? rows[p * panel.stride + c] : 0.0;
  const double *l0 = rows, *l1 = l0 + panel.stride, *l2 = l1 + panel.stride, *l3 = l2 + panel.stride;
  double *t0 = values_.data() + right.begin, *t1 = t0 + right.stride, *t2 = t1 + right.stride,
         *t3 = t2 + right.stride;
  const auto off = [&](int c, int i) {
    return factor[c][0] * l0[i] + factor[c][1] * l1[i] + factor[c][2] * l2[i] + factor[c][3] * l3[i];
  };
#pragma omp simd
  for (int i = 0; i < length; ++i) {
    t0[i] -= off(0, i);
    t1[i] -= off(1, i);
    t2[i] -= off(2, i);
    t3[i] -= off(3, i);
  }
}

bool EnvelopeCholesky::factorise() {
  for (std::size_t n = 0; n < panels_.size(); ++n) {
    const Panel& panel = panels_[n];
    if (!factorise(panel)) return false;
    std::size_t right = n + 1;
    for (int row = width; row < panel.rows; row += width, ++right)
      take_off(panel, values_.data() + panel.begin + row, panel.rows - row, panels_[right]);
  }
  return true;
}

void EnvelopeCholesky::solve(double* x) const {
  for (std::size_t n = 0; n < panels_.size(); ++n) {
    const Panel& panel = panels_[n];
    const double* const columns = values_.data() + panel.begin;
    const int start = static_cast<int>(n) * width, present = std::min(width, size_ - start);
    double* const own = x + start;
    double known[width] = {};
    for (int c = 0; c < present; ++c) {
      for (int p = 0; p < c; ++p) own[c] -= columns[p * panel.stride + c] * known[p];
      known[c] = own[c] /= columns[c * panel.stride + c];
    }
    const double *l0 = columns, *l1 = l0 + panel.stride, *l2 = l1 + panel.stride, *l3 = l2 + panel.stride;
#pragma omp simd
    for (int i = width; i < panel.rows; ++i)
      own[i] -= known[0] * l0[i] + known[1] * l1[i] + known[2] * l2[i] + known[3] * l3[i];
  }
  for (std::size_t n = panels_.size(); n-- > 0;) {
    const Panel& panel = panels_[n];
    const double* const columns = values_.data() + panel.begin;
    const int start = static_cast<int>(n) * width, present = std::min(width, size_ - start);
    double* const own = x + start;
    const double *l0 = columns, *l1 = l0 + panel.stride, *l2 = l1 + panel.stride, *l3 = l2 + panel.stride;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
    for (int i = width; i < panel.rows; ++i) {
      s0 += l0[i] * own[i];
      s1 += l1[i] * own[i];
      s2 += l2[i] * own[i];
      s3 += l3[i] * own[i];
    }
    const double sums[width] = {s0, s1, s2, s3};
    for (int c = present - 1; c >= 0; --c) {
      const double* const column = columns + c * panel.stride;
      double rest = own[c] - sums[c];
      for (int p = c + 1; p < present; ++p) rest -= column[p] * own[p];
      own[c] = rest / column[c];
    }
  }
}

}  // namespace granvof::linear
