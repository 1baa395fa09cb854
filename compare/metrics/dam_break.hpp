// Front of a collapsing water column, delta = x / a against tau = t sqrt(2 g / a) (Martin & Moyce 1952).
#pragma once

#include <cmath>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// `width` a [m] of the column, > 0; `shift` is added to tau, as the published series starts when the
// diaphragm has broken and not at the first motion.
inline Curve dam_break_front(const Curve& liquid_front, double width, double gravity, double shift) {
  Curve scaled = liquid_front;
  const double per_second = std::sqrt(2.0 * gravity / width);
  for (double& t : scaled.time) t = t * per_second + shift;
  scaled.widest *= per_second;
  for (double& x : scaled.value) x /= width;
  return scaled;
}

}  // namespace granvof::compare
