#include "solver/linear/envelope_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace granvof::linear {
namespace {

double product(const double* a, const double* b, int n) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void EnvelopeCholesky::reset(const std::vector<int>& first) {
  first_ = first;
  begin_.resize(first.size());
  std::ptrdiff_t end = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    begin_[i] = end - first[i];
    end += static_cast<std::ptrdiff_t>(i) - first[i] + 1;
  }
  values_.assign(static_cast<std::size_t>(end), 0.0);
}

bool EnvelopeCholesky::factorise() {
  for (int i = 0; i < size(); ++i) {
    double* row = values_.data() + begin_[i];
    for (int j = first_[i]; j < i; ++j) {
      const double* other = values_.data() + begin_[j];
      const int from = std::max(first_[i], first_[j]);
      row[j] = (row[j] - product(row + from, other + from, j - from)) / other[j];
    }
    const double square = row[i] - product(row + first_[i], row + first_[i], i - first_[i]);
    if (!(square > 0.0)) return false;
    row[i] = std::sqrt(square);
  }
  return true;
}

void EnvelopeCholesky::solve(double* x) const {
  for (int i = 0; i < size(); ++i) {
    const double* row = values_.data() + begin_[i];
    x[i] = (x[i] - product(row + first_[i], x + first_[i], i - first_[i])) / row[i];
  }
  for (int i = size() - 1; i >= 0; --i) {
    const double* row = values_.data() + begin_[i];
    const double value = x[i] /= row[i];
#pragma omp simd
    for (int j = first_[i]; j < i; ++j) x[j] -= row[j] * value;
  }
}

}  // namespace granvof::linear
