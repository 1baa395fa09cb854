// Rate at which a floating bed comes to rest.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct Decay {
  double rate = 0.0;       // k [1/s]
  double rest = 0.0;       // the value approached
  double amplitude = 0.0;  // A at the start of the window
  double residual = 0.0;   // rms misfit divided by |A|
};

// Overdamped approach: y = rest + A exp(-k (t - t0)) fitted over the window by least squares; `rest` and A
// are linear in the fit, k is searched between 0.1 and 200 window lengths. Nothing for fewer than five
// samples or where the best k lies at an end of the range (the curve holds no decay).
std::optional<Decay> exponential_approach(const Curve& curve, Window window);

// Oscillation: least squares of log |deviation from the mean| through the extremes of each half cycle.
std::optional<double> envelope_decay_rate(const Curve& curve, Window window);

}  // namespace granvof::compare
