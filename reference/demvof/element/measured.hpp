// A measured number and how far it may be off.
#pragma once

#include <vector>

namespace demvof {

struct Measured {
  double value = 0.0;
  double band = 0.0;  // half width: twice the standard error
};

// Of repeats that are independent; needs two or more, else std::invalid_argument.
Measured mean_of(const std::vector<double>& repeats);

// Straight line through (x, y) by least squares, at x = 0. Needs three points or more at more than one x,
// else std::invalid_argument.
Measured intercept_of(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace demvof
