#include "compare/metrics/known_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

// Weight less buoyancy of the grains of a cell [Pa].
double weight_of(const CellFields& fields, const Scene& scene, std::size_t c) {
  const double pores = std::lerp(scene.gas.density, scene.liquid.density, fields.alpha[c]);
  return fields.f_s[c] * (scene.solid.density - pores) * normal_gravity(scene) * fields.spacing[1];
}

}  // namespace

std::optional<double> mean_solid_pressure(const CellFields& fields) {
  double sum = 0.0;
  int cells = 0;
  for (std::size_t c = 0; c < fields.p_s.size(); ++c)
    if (fields.f_s[c] > 0.0) {
      sum += fields.p_s[c];
      ++cells;
    }
  return cells > 0 ? std::optional(sum / cells) : std::nullopt;
}

std::optional<double> slip_in_the_middle(const CellFields& fields) {
  const int j = fields.cells[1] / 2;
  double sum = 0.0;
  for (int k = 0; k < fields.cells[2]; ++k)
    for (int i = 0; i < fields.cells[0]; ++i) {
      const std::size_t c = fields.index(i, j, k);
      if (fields.f_s[c] <= 0.0) return std::nullopt;
      sum += fields.u_c[1][c] - fields.u_s[1][c];
    }
  return sum / (fields.cells[0] * fields.cells[2]);
}

std::optional<double> weight_distance(const CellFields& fields, const Scene& scene) {
  if (fields.p_s.empty()) return std::nullopt;
  const auto full = [&](std::size_t c) { return fields.f_s[c] >= 0.95 * scene.contact.solid_fraction_min; };
  double distance = 0.0, largest = 0.0;
  for (int k = 0; k < fields.cells[2]; ++k)
    for (int i = 0; i < fields.cells[0]; ++i) {
      double above = 0.0;
      for (int j = fields.cells[1] - 1; j >= 0; --j) {
        const std::size_t c = fields.index(i, j, k);
        const double own = weight_of(fields, scene, c), borne = above + 0.5 * own;
        above += own;
        if (!full(c) || j + 1 == fields.cells[1] || !full(fields.index(i, j + 1, k))) continue;
        distance = std::max(distance, std::abs(fields.p_s[c] - borne));
        largest = std::max(largest, borne);
      }
    }
  return largest > 0.0 ? std::optional(distance / largest) : std::nullopt;
}

double mirror_distance(const CellFields& fields) {
  double distance = 0.0;
  for (int k = 0; k < fields.cells[2]; ++k)
    for (int j = 0; j < fields.cells[1]; ++j)
      for (int i = 0; 2 * i < fields.cells[0]; ++i) {
        const std::size_t here = fields.index(i, j, k), there = fields.index(fields.cells[0] - 1 - i, j, k);
        distance = std::max({distance, std::abs(fields.f_s[here] - fields.f_s[there]),
                             std::abs(fields.alpha[here] - fields.alpha[there])});
      }
  return distance;
}

}  // namespace granvof::compare
