// Cholesky factorisation of a symmetric positive definite matrix within its envelope.
//
// Row i is kept from the first column where it is not zero to the diagonal; factorising fills the envelope
// and nothing outside it (George & Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981,
// ch. 4). Costs half the sum of the squared row lengths: for long and narrow systems, numbered along their
// length, far less than an iteration takes that stalls.
#pragma once

#include <cstddef>
#include <vector>

namespace granvof::linear {

class EnvelopeCholesky {
 public:
  // A matrix of zeros; first[i] <= i: the first column that row i may use.
  void reset(const std::vector<int>& first);
  // Adds to the element at (i, j), and with it to (j, i). max(first[i], first[j]) allowing.
  void add(int i, int j, double value) {
    if (j > i)
      values_[begin_[j] + i] += value;
    else
      values_[begin_[i] + j] += value;
  }
  // A = L L^T in place. False, and nothing to solve with, where A is not positive definite.
  bool factorise();
  // x holds the right-hand side, then the answer; size() values.
  void solve(double* x) const;

  int size() const { return static_cast<int>(first_.size()); }

 private:
  std::vector<int> first_;
  std::vector<std::ptrdiff_t> begin_;  // of column 0 of a row: its first value is at begin_[i] + first_[i]
  std::vector<double> values_;
};

}  // namespace granvof::linear
