// Volumes and bounds: what must hold at every moment of a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// Largest |V(t) - V(0)| / V(0) [-] of a volume against time; nothing where V(0) is not positive.
inline std::optional<double> volume_error(const Curve& volume) {
  if (volume.empty() || volume.value.front() <= 0.0) return std::nullopt;
  double largest = 0.0;
  for (const double value : volume.value) largest = std::max(largest, std::abs(value - volume.value.front()));
  return largest / volume.value.front();
}

}  // namespace granvof::compare
