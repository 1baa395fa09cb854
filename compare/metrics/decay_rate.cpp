#include "compare/metrics/decay_rate.hpp"

#include <cmath>

#include "compare/metrics/line_fit.hpp"

namespace granvof::compare {
std::optional<double> approach_rate(const Curve& curve, Window window, double rest) {
  const Curve inside = clip(curve, window);
  if (inside.size() < 3) return std::nullopt;
  std::vector<double> log_deviation;
  for (const double value : inside.value) {
    const double deviation = value - rest;
    if (deviation == 0.0 || (deviation > 0.0) != (inside.value.front() > rest)) return std::nullopt;
    log_deviation.push_back(std::log(std::abs(deviation)));
  }
  return -line_fit(inside.time, log_deviation).slope;
}

Curve resolved_part(const Curve& curve, double rest, double least) {
  Curve part;
  part.widest = curve.widest;
  for (std::size_t i = 0; i < curve.size() && std::abs(curve.value[i] - rest) >= least; ++i) {
    part.time.push_back(curve.time[i]);
    part.value.push_back(curve.value[i]);
  }
  return part;
}

std::optional<double> envelope_decay_rate(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  const auto mean = time_mean(inside);
  if (!mean) return std::nullopt;
  std::vector<double> time, log_peak;
  double peak = 0.0, peak_time = 0.0;
  int half_cycles = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const double deviation = inside.value[i] - *mean;
    if (i > 0 && (deviation < 0.0) != (inside.value[i - 1] - *mean < 0.0)) {
      if (half_cycles > 0 && peak > 0.0) {  // the first half cycle is cut by the window
        time.push_back(peak_time);
        log_peak.push_back(std::log(peak));
      }
      ++half_cycles;
      peak = 0.0;
    }
    if (std::abs(deviation) > peak) {
      peak = std::abs(deviation);
      peak_time = inside.time[i];
    }
  }
  if (time.size() < 2) return std::nullopt;
  return -line_fit(time, log_peak).slope;
}

}  // namespace granvof::compare
