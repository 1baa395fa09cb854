// The fit l = a t^b of a run-out curve, eq (26).
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct PowerLaw {
  double factor = 0.0;    // a, [unit of l / s^b]
  double exponent = 0.0;  // b [-]
};

// Least squares of log l against log t over the samples of the window with t > 0 and l > 0; nothing for fewer
// than two such samples.
std::optional<PowerLaw> power_law(const Curve& curve, Window window);

}  // namespace granvof::compare
