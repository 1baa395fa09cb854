// Move of the toe of a deposit that should stay at rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// Largest distance, at any time of the window, of the front from where it is at the window's begin [unit of
// the curve]: grains that run off and are stopped by the far wall, or come back, count too. Nothing where the
// curve does not cover the window.
inline std::optional<double> largest_move(const Curve& front, Window window) {
  const auto before = value_at(front, window.begin);
  const auto after = value_at(front, window.end);
  if (!before || !after) return std::nullopt;
  double most = std::abs(*after - *before);
  for (const double x : clip(front, window).value) most = std::max(most, std::abs(x - *before));
  return most;
}

}  // namespace granvof::compare
