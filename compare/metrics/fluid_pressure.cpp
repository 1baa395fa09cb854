#include "compare/metrics/fluid_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

// Mean of a field over the cells of row j.
double mean_of_row(const std::vector<double>& values, const CellFields& fields, int j) {
  const auto [nx, ny, nz] = fields.cells;
  double sum = 0.0;
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i) sum += values[static_cast<std::size_t>((k * ny + j) * nx + i)];
  return sum / (static_cast<double>(nx) * nz);
}

}  // namespace

double hydrostatic_distance(const CellFields& fields, const Scene& scene) {
  const Vec3 g = gravity_of(scene);
  double distance = 0.0, largest = 0.0;
  std::size_t c = 0;
  for (int k = 0; k < fields.cells[2]; ++k)
    for (int j = 0; j < fields.cells[1]; ++j)
      for (int i = 0; i < fields.cells[0]; ++i, ++c) {
        const double x = (i + 0.5) * fields.spacing[0] - 0.5 * scene.tank[0],
                     y = (j + 0.5) * fields.spacing[1] - scene.tank[1];
        const double at_rest = scene.liquid.density * (g[0] * x + g[1] * y);
        distance = std::max(distance, std::abs(fields.p_c[c] - at_rest));
        largest = std::max(largest, std::abs(at_rest));
      }
  return distance / largest;
}

double ergun_ratio(const CellFields& fields, const Scene& scene) {
  const double speed = scene.sides[bottom].inflow.speed, d = scene.solid.diameter, h = fields.spacing[1];
  const Fluid& liquid = scene.liquid;
  int top = fields.cells[1] - 1;
  while (top > 0 && mean_of_row(fields.f_s, fields, top) < 0.95 * scene.contact.solid_fraction_min) --top;
  if (top == 0) return 0.0;
  double ergun = 0.0;
  for (int j = 1; j <= top; ++j) {
    const double f = 0.5 * (mean_of_row(fields.f_s, fields, j - 1) + mean_of_row(fields.f_s, fields, j)),
                 pores = std::pow(1.0 - f, 3);
    ergun += h * (150.0 * f * f * liquid.viscosity * speed / (pores * d * d) +
                  1.75 * f * liquid.density * speed * speed / (pores * d));
  }
  const double fall = mean_of_row(fields.p_c, fields, 0) - mean_of_row(fields.p_c, fields, top);
  return (fall - liquid.density * normal_gravity(scene) * top * h) / ergun;
}

}  // namespace granvof::compare
