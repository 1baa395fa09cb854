// Rate at which a floating bed comes to rest.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// Overdamped approach to `rest`: minus the slope of log |y - rest| against time over the window, least
// squares [1/s]. Nothing for fewer than three samples off `rest`, or where the deviation changes sign in the
// window: what is left of it there is not a decay.
std::optional<double> approach_rate(const Curve& curve, Window window, double rest);

// The samples before the deviation from `rest` first falls below `least`.
Curve resolved_part(const Curve& curve, double rest, double least);

// Oscillation: least squares of log |deviation from the mean| through the extremes of each half cycle.
std::optional<double> envelope_decay_rate(const Curve& curve, Window window);

}  // namespace granvof::compare
