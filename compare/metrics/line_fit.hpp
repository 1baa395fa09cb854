// Least-squares straight line.
#pragma once

#include <vector>

namespace granvof::compare {

struct Line {
  double offset = 0.0;  // value at x = 0
  double slope = 0.0;
};

// Through at least two points with different x.
Line line_fit(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace granvof::compare
