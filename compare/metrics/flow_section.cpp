#include "compare/metrics/flow_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

constexpr double liquid_alone = 0.999;  // alpha of a cell that the surface does not cross

}  // namespace

double speed_in_film(const Scene& scene, double depth, double y) {
  return scene.liquid.density * gravity_of(scene)[0] / scene.liquid.viscosity * (depth * y - 0.5 * y * y);
}

double liquid_depth_in_the_middle(const CellFields& fields) {
  double depth = 0.0;
  for (int j = 0; j < fields.cells[1]; ++j)
    depth += fields.alpha[fields.index(fields.cells[0] / 2, j, 0)] * fields.spacing[1];
  return depth;
}

std::optional<double> film_distance(const CellFields& fields, const Scene& scene) {
  const int i = fields.cells[0] / 2;
  const double h = liquid_depth_in_the_middle(fields);
  const auto liquid = [&](int j) { return fields.alpha[fields.index(i, j, 0)] > liquid_alone; };
  double distance = 0.0, largest = 0.0;
  for (int j = 0; j + 1 < fields.cells[1] && liquid(j) && liquid(j + 1); ++j) {
    const double film = speed_in_film(scene, h, (j + 0.5) * fields.spacing[1]);
    distance = std::max(distance, std::abs(fields.u_c[0][fields.index(i, j, 0)] - film));
    largest = std::max(largest, std::abs(film));
  }
  return largest > 0.0 ? std::optional(distance / largest) : std::nullopt;
}

std::optional<double> reattachment_length(const CellFields& fields, const Scene& scene) {
  if (scene.obstacles.empty() || scene.obstacles.front().lower[1] > 0.0) return std::nullopt;
  const Box& step = scene.obstacles.front();
  const double dx = fields.spacing[0];
  const auto behind = static_cast<int>(std::lround(step.upper[0] / dx));
  std::optional<double> length;
  for (int i = behind; i + 1 < fields.cells[0]; ++i) {
    const double here = fields.u_c[0][fields.index(i, 0, 0)], next = fields.u_c[0][fields.index(i + 1, 0, 0)];
    if (here < 0.0 && next >= 0.0)
      length = ((i + 0.5 + here / (here - next)) * dx - step.upper[0]) / step.upper[1];
  }
  return length;
}

}  // namespace granvof::compare
