#include "compare/metrics/run_out.hpp"

#include <algorithm>
#include <cmath>

namespace granvof::compare {

double collapse_time(const ColumnSize& column) {
  return std::sqrt(column.height / column.gravity);
}

Curve run_out(const Curve& front, const ColumnSize& column) {
  const auto start = value_at(front, 0.0);
  if (!start) return {};
  const double tau = collapse_time(column);
  Curve scaled;
  scaled.widest = front.widest / tau;
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (front.time[i] < 0.0) continue;
    scaled.time.push_back(front.time[i] / tau);
    scaled.value.push_back((front.value[i] - *start) / column.height);
  }
  return scaled;
}

Curve before_wall(const Curve& front, double far_end, double cell) {
  Curve free;
  free.widest = front.widest;
  for (std::size_t i = 0; i < front.size() && front.value[i] < far_end - cell; ++i) {
    free.time.push_back(front.time[i]);
    free.value.push_back(front.value[i]);
  }
  return free;
}

std::optional<double> rms_distance(const Curve& a, const Curve& b, Window window) {
  std::vector<double> times{window.begin, window.end};
  for (const Curve* curve : {&a, &b})
    for (const double t : curve->time)
      if (t > window.begin && t < window.end) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Curve squared;
  for (const double t : times) {
    const auto va = value_at(a, t);
    const auto vb = value_at(b, t);
    if (!va || !vb) return std::nullopt;
    squared.time.push_back(t);
    squared.value.push_back((*va - *vb) * (*va - *vb));
  }
  const auto mean = time_mean(squared);
  if (!mean) return std::nullopt;
  return std::sqrt(*mean);
}

}  // namespace granvof::compare
