#include "compare/metrics/base_pressure.hpp"

#include <cmath>

namespace granvof::compare {

Curve excess_pressure(const Curve& base_pressure, double rest) {
  Curve excess = base_pressure;
  for (double& value : excess.value) value -= rest;
  return excess;
}

std::optional<double> peak_pressure(const Curve& excess, Window window) {
  const Curve inside = clip(excess, window);
  std::optional<double> peak;
  for (const double value : inside.value)
    if (!peak || std::abs(value) > std::abs(*peak)) peak = value;
  return peak;
}

std::optional<double> onset_sign(const Curve& excess, Window window, double quiet) {
  const auto mean = time_mean(clip(excess, window));
  if (!mean) return std::nullopt;
  if (std::abs(*mean) < quiet) return 0.0;
  return *mean > 0.0 ? 1.0 : -1.0;
}

}  // namespace granvof::compare
