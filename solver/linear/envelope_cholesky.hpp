// Cholesky factorisation of a symmetric positive definite matrix within its envelope.
//
// Row i is used from the first column where it is not zero to the diagonal; factorising fills the envelope
// and nothing outside it (George & Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981,
// ch. 4). Costs half the sum of the squared row lengths: for long and narrow systems, numbered along their
// length, far less than an iteration takes that stalls.
//
// Columns are kept in panels of four, down to the last row that any column up to them reaches. A panel is
// factorised and taken off those to its right at once: four values are read for sixteen products, along the
// columns, where nothing is summed across.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/grid/memory.hpp"

namespace granvof::linear {

class EnvelopeCholesky {
 public:
  // A matrix of zeros; first[i] <= i: the first column that row i may use.
  void reset(const std::vector<int>& first);
  // Adds to the element at (i, j), and with it to (j, i). max(first[i], first[j]) allowing.
  void add(int i, int j, double value) {
    const int row = i > j ? i : j, column = i > j ? j : i;
    const Panel& panel = panels_[static_cast<std::size_t>(column / width)];
    values_[panel.begin + column % width * panel.stride + row - column / width * width] += value;
  }
  // A = L L^T in place. False, and nothing to solve with, where A is not positive definite.
  bool factorise();
  // x holds the right-hand side, then the answer; size() values.
  void solve(double* x) const;

  int size() const { return size_; }

 private:
  static constexpr int width = 4;  // columns of a panel

  struct Panel {
    std::size_t begin = 0;   // its first value: the diagonal's, of its first column
    std::size_t stride = 0;  // of its columns
    int rows = width;        // from its first column on
  };

  bool factorise(const Panel& panel);
  void take_off(const Panel& panel, const double* rows, int length, const Panel& right);

  int size_ = 0;
  std::vector<Panel> panels_;
  Buffer<double> values_;
};

}  // namespace granvof::linear
