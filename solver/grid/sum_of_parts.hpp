// A sum over several ranges of a box that is cut among processes: not every process has every one of them,
// and all meet once.
#pragma once

#include "solver/grid/reduce.hpp"

namespace granvof {

class SumOfParts {
 public:
  explicit SumOfParts(const Layout& layout) : layout_(layout) {}

  // Adds weight * (sum of body(index)) over this process's values of a range.
  template <typename Body>
  void add(double weight, const Range& r, Body&& body) {
    mine_ += weight * of_process::sum_over(layout_, r, body);
  }

  // Of all processes; all of them at once.
  double total() const { return of_all(layout_, mine_); }

 private:
  const Layout& layout_;
  double mine_ = 0.0;
};

}  // namespace granvof
