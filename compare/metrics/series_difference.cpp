#include "compare/metrics/series_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "solver/scene/scales.hpp"

namespace granvof::compare {
namespace {

// What it took, not what came out.
constexpr std::array<std::string_view, 3> effort{"newton", "linear", "friction_iterations"};

double scale_of(std::string_view unit, const Scene& scene) {
  const Scales s = scales_of(scene);
  if (unit == "-") return 1.0;
  if (unit == "s") return s.time();
  if (unit == "m") return s.length;
  if (unit == "m/s") return s.velocity;
  if (unit == "m2/s2") return s.velocity * s.velocity;
  if (unit == "Pa") return s.pressure;
  if (unit == "J") return s.energy;
  if (unit == "m3") return scene.tank[0] * scene.tank[1] * scene.tank[2];
  if (unit == "deg") return 180.0 / std::numbers::pi;
  throw std::out_of_range("no scale for a column in " + std::string(unit));
}

// Index of each row of `few` among those of `many`, both in units of time of their own.
std::optional<std::vector<std::size_t>> same_rows(const std::vector<double>& few,
                                                  const std::vector<double>& many) {
  std::vector<std::size_t> found;
  const double slack = 1e-9 * few.back();
  for (const double time : few) {
    const auto at = std::ranges::lower_bound(many, time - slack);
    if (at == many.end() || *at > time + slack) return std::nullopt;
    found.push_back(static_cast<std::size_t>(at - many.begin()));
  }
  return found;
}

std::vector<double> times_of(const Series& series, const Scene& scene) {
  std::vector<double> times;
  for (const Value& time : series.column("time")) times.push_back(time.value() / scales_of(scene).time());
  return times;
}

bool same_columns(const Series& a, const Series& b) {
  return std::ranges::equal(a.columns, b.columns, {}, column_header, column_header);
}

double difference(const Value& a, double scale_a, const Value& b, double scale_b) {
  if (a.has_value() != b.has_value()) return std::numeric_limits<double>::infinity();
  return a ? std::abs(*a / scale_a - *b / scale_b) : 0.0;
}

}  // namespace

std::optional<SeriesDifference> series_difference(const Series& a, const Scene& scene_a, const Series& b,
                                                  const Scene& scene_b) {
  if (b.rows.size() < a.rows.size()) return series_difference(b, scene_b, a, scene_a);
  if (a.rows.empty() || !same_columns(a, b)) return std::nullopt;
  const std::vector<double> times = times_of(a, scene_a);
  const auto rows = same_rows(times, times_of(b, scene_b));
  if (!rows) return std::nullopt;
  SeriesDifference worst;
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    const Column& column = a.columns[c];
    if (std::ranges::find(effort, column.name) != effort.end()) continue;
    const double scale_a = scale_of(column.unit, scene_a), scale_b = scale_of(column.unit, scene_b);
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const double off = difference(a.rows[i][c], scale_a, b.rows[(*rows)[i]][c], scale_b);
      if (off > worst.largest) worst = {off, column.name, times[i]};
    }
  }
  return worst;
}

}  // namespace granvof::compare
