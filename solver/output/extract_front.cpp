#include "solver/output/extract_front.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/output/measures.hpp"

namespace granvof::scalar {

namespace {

constexpr double dilute_threshold = 0.30;
constexpr double quantile = 0.995;

Value larger(Value a, Value b) {
  return a && b ? std::max(*a, *b) : (a ? a : b);
}

// Largest x with f_s >= threshold in the layer z = k.
Value front_of_layer(const CellFields& fields, int k, double threshold) {
  Value front;
  for (int j = 0; j < fields.cells[1]; ++j) {
    const auto begin = fields.f_s.begin() + static_cast<std::ptrdiff_t>(cell_index(fields, 0, j, k));
    const std::vector<double> row(begin, begin + fields.cells[0]);
    front = larger(front, last_crossing(row, fields.spacing[0], threshold));
  }
  return front;
}

Value front(const CellFields& fields, double threshold) {
  Value largest;
  for (int k = 0; k < fields.cells[2]; ++k) largest = larger(largest, front_of_layer(fields, k, threshold));
  return largest;
}

}  // namespace

Value front_dense(const CellFields& fields, const Scene& scene) {
  return front(fields, dense_threshold(scene));
}

Value front_dense_mean(const CellFields& fields, const Scene& scene) {
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < fields.cells[2]; ++k) {
    if (const auto x = front_of_layer(fields, k, dense_threshold(scene))) {
      sum += *x;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

Value front_dilute(const CellFields& fields, const Scene&) {
  return front(fields, dilute_threshold);
}

Value front_quantile(const CellFields& fields, const Scene& scene) {
  const auto volume = solid_volume_along_x(fields, scene);
  double total = 0.0;
  for (const double v : volume) total += v;
  if (total <= 0.0) return std::nullopt;
  double left = 0.0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    if (volume[i] > 0.0 && left + volume[i] >= quantile * total) {
      return (static_cast<double>(i) + (quantile * total - left) / volume[i]) * fields.spacing[0];
    }
    left += volume[i];
  }
  return static_cast<double>(volume.size()) * fields.spacing[0];
}

Value deposit_height(const CellFields& fields, const Scene& scene) {
  const auto height = bed_height_profile(fields, scene);
  const double largest = *std::max_element(height.begin(), height.end());
  if (largest <= 0.0) return std::nullopt;
  return largest;
}

Value slope(const CellFields& fields, const Scene& scene) {
  const auto height = bed_height_profile(fields, scene);
  const double largest = *std::max_element(height.begin(), height.end());
  if (largest <= 0.0) return std::nullopt;
  std::size_t i = height.size();
  while (height[i - 1] < 0.8 * largest) --i;  // cell i is the first below 80 %
  double n = 0.0;
  double sum_x = 0.0;
  double sum_h = 0.0;
  double sum_xx = 0.0;
  double sum_xh = 0.0;
  for (; i < height.size() && height[i] >= 0.2 * largest; ++i) {
    const double x = (static_cast<double>(i) + 0.5) * fields.spacing[0];
    n += 1.0;
    sum_x += x;
    sum_h += height[i];
    sum_xx += x * x;
    sum_xh += x * height[i];
  }
  if (n < 3.0) return std::nullopt;
  const double gradient = (n * sum_xh - sum_x * sum_h) / (n * sum_xx - sum_x * sum_x);
  return std::atan(-gradient) * 180.0 / std::numbers::pi;
}

}  // namespace granvof::scalar
