#include "compare/metrics/immersion.hpp"

namespace granvof::compare {

std::optional<Immersion> immersion(const Curve& centre, const Curve& height, const Curve& interface,
                                   Window window) {
  const auto y_c = time_mean(clip(centre, window));
  const auto full = time_mean(clip(height, window));
  const auto y_i = time_mean(clip(interface, window));
  if (!y_c || !full || !y_i || *full <= 0.0) return std::nullopt;
  return Immersion{0.5 * *full + (*y_i - *y_c), *full};
}

}  // namespace granvof::compare
