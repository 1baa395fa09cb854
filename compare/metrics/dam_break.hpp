// Front of a collapsing water column, delta = x / a against tau = t sqrt(2 g / a) (Martin & Moyce 1952).
#pragma once

#include <cmath>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// `width` a [m] of the column, > 0; `shift` is added to tau, as the published series starts when the
// diaphragm has broken and not at the first motion.
inline Curve dam_break_front(const Curve& liquid_front, double width, double gravity, double shift) {
  Curve scaled = liquid_front;
  for (double& t : scaled.time) t = t * std::sqrt(2.0 * gravity / width) + shift;
  for (double& x : scaled.value) x /= width;
  return scaled;
}

}  // namespace granvof::compare
