#include "compare/metrics/curve.hpp"

#include <algorithm>

namespace granvof::compare {

Curve clip(const Curve& curve, Window window) {
  Curve inside;
  inside.widest = curve.widest;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.time[i] < window.begin || curve.time[i] > window.end) continue;
    inside.time.push_back(curve.time[i]);
    inside.value.push_back(curve.value[i]);
  }
  return inside;
}

std::optional<double> value_at(const Curve& curve, double time) {
  if (curve.empty()) return std::nullopt;
  const double slack = 1e-9 * (curve.time.back() - curve.time.front());
  if (time < curve.time.front() - slack || time > curve.time.back() + slack) return std::nullopt;
  const auto after = std::upper_bound(curve.time.begin(), curve.time.end(), time);
  if (after == curve.time.begin()) return curve.value.front();
  if (after == curve.time.end()) return curve.value.back();
  const std::size_t i = static_cast<std::size_t>(after - curve.time.begin());
  const bool sampled = curve.time[i - 1] == time;
  if (!sampled && curve.time[i] - curve.time[i - 1] > curve.widest) return std::nullopt;
  const double share = (time - curve.time[i - 1]) / (curve.time[i] - curve.time[i - 1]);
  return curve.value[i - 1] + share * (curve.value[i] - curve.value[i - 1]);
}

std::optional<double> integral(const Curve& curve) {
  if (curve.size() < 2) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double step = curve.time[i] - curve.time[i - 1];
    if (step > curve.widest) return std::nullopt;
    sum += 0.5 * (curve.value[i] + curve.value[i - 1]) * step;
  }
  return sum;
}

std::optional<double> time_mean(const Curve& curve) {
  const auto area = integral(curve);
  if (!area) return std::nullopt;
  return *area / (curve.time.back() - curve.time.front());
}

std::optional<double> maximum(const Curve& curve) {
  if (curve.empty()) return std::nullopt;
  return *std::max_element(curve.value.begin(), curve.value.end());
}

std::optional<double> minimum(const Curve& curve) {
  if (curve.empty()) return std::nullopt;
  return *std::min_element(curve.value.begin(), curve.value.end());
}

Curve mean_curve(const std::vector<Curve>& curves) {
  Curve mean;
  std::vector<double> times;
  for (const Curve& curve : curves) {
    mean.widest = std::min(mean.widest, curve.widest);
    times.insert(times.end(), curve.time.begin(), curve.time.end());
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const double x : times) {
    double sum = 0.0;
    bool covered = true;
    for (const Curve& curve : curves) {
      const auto value = value_at(curve, x);
      covered = covered && value.has_value();
      sum += value.value_or(0.0);
    }
    if (!covered) continue;
    mean.time.push_back(x);
    mean.value.push_back(sum / static_cast<double>(curves.size()));
  }
  return mean;
}

}  // namespace granvof::compare
