// Slope of a deposit that should stay at rest.
#pragma once

#include <optional>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// Slope at the end of the window less the slope at its begin [unit of the curve]; nothing where the curve
// does not cover the window.
inline std::optional<double> slope_change(const Curve& slope, Window window) {
  const auto before = value_at(slope, window.begin);
  const auto after = value_at(slope, window.end);
  if (!before || !after) return std::nullopt;
  return *after - *before;
}

}  // namespace granvof::compare
