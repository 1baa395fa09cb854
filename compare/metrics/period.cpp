#include "compare/metrics/period.hpp"

#include <cmath>

namespace granvof::compare {
namespace {

struct Crossings {
  std::vector<double> up, down;
};

Crossings crossings(const Curve& curve, double mean) {
  double square = 0.0;
  for (const double value : curve.value) square += (value - mean) * (value - mean);
  const double band = 0.2 * std::sqrt(square / static_cast<double>(curve.size()));
  Crossings found;
  int side = 0;             // the side of the band last visited
  double crossed_at = 0.0;  // the last crossing of the mean, not confirmed yet
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double now = curve.value[i] - mean;
    if (i > 0) {
      const double before = curve.value[i - 1] - mean;
      if ((before < 0.0) != (now < 0.0))
        crossed_at = curve.time[i - 1] + (curve.time[i] - curve.time[i - 1]) * before / (before - now);
    }
    const int beyond = now > band ? 1 : (now < -band ? -1 : 0);
    if (beyond == 0 || beyond == side) continue;
    if (side != 0) (beyond > 0 ? found.up : found.down).push_back(crossed_at);
    side = beyond;
  }
  return found;
}

}  // namespace

std::optional<Oscillation> oscillation(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  auto mean = time_mean(inside);
  if (!mean) return std::nullopt;
  Crossings found;
  for (int repeat = 0; repeat < 4; ++repeat) {
    found = crossings(inside, *mean);
    if (found.up.size() < 2) return std::nullopt;
    const auto refined = time_mean(clip(inside, {found.up.front(), found.up.back()}));
    if (!refined) return std::nullopt;
    mean = refined;
  }
  // Upward and downward crossings err in opposite directions when the mean is off: use both.
  double total = found.up.back() - found.up.front();
  std::size_t cycles = found.up.size() - 1;
  if (found.down.size() >= 2) {
    total += found.down.back() - found.down.front();
    cycles += found.down.size() - 1;
  }
  if (found.up.size() < 3 && found.down.size() < 3) return std::nullopt;
  return Oscillation{total / static_cast<double>(cycles), static_cast<int>(found.up.size()) - 1,
                     0.5 * (*maximum(inside) - *minimum(inside))};
}

}  // namespace granvof::compare
