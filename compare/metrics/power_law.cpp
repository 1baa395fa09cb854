#include "compare/metrics/power_law.hpp"

#include <cmath>

#include "compare/metrics/line_fit.hpp"

namespace granvof::compare {

std::optional<PowerLaw> power_law(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  std::vector<double> log_time, log_value;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside.time[i] <= 0.0 || inside.value[i] <= 0.0) continue;
    log_time.push_back(std::log(inside.time[i]));
    log_value.push_back(std::log(inside.value[i]));
  }
  if (log_time.size() < 2) return std::nullopt;
  const Line line = line_fit(log_time, log_value);
  return PowerLaw{std::exp(line.offset), line.slope};
}

}  // namespace granvof::compare
