#include "solver/operators/bed_surface.hpp"

#include <cmath>

#include "solver/operators/mixture.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

constexpr int vertical = 1;

bool closed_end(const Grid& grid, bool upper) {
  return grid.side(vertical, upper).bears_grains;
}

Range row_of_cells(const Grid& grid, int j, int ghosts) {
  Range row = grid.cells_and_ghosts(ghosts);
  row.lower[vertical] = j;
  row.upper[vertical] = j + 1;
  return row;
}

}  // namespace

void rest_on_the_bed(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha,
                     const Field& p_s, Field& support, Field& resting) {
  const double rho_s = scene.solid.density, rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double packed = scene.contact.solid_fraction_min;
  const double half = 0.5 * normal_gravity(scene) * grid.h[vertical];
  const double *f = f_s.data(), *a = alpha.data(), *p = p_s.data();
  double *r = support.data(), *out = resting.data();
  resting.fill(0.0);
  const int n = grid.cells.n[vertical];
  const char* solid = grid.obstacles.solid();
  for (const bool light : {false, true}) {
    if (light ? rho_s >= std::fmax(rho_l, rho_g) : rho_s <= std::fmin(rho_l, rho_g)) continue;
    const std::ptrdiff_t below = light ? grid.stride(vertical) : -grid.stride(vertical);
    const double sign = light ? -1.0 : 1.0;
    const double end = closed_end(grid, light) ? 1.0 : 0.0;
    for (int step = 0; step < n; ++step) {
      const bool first = step == 0;
      for_each(grid.cells, row_of_cells(grid, light ? n - 1 - step : step, 0), [=](std::ptrdiff_t c) {
        const double beneath = f[c + below] / packed;
        const bool on_obstacle = solid != nullptr && !first && solid[c + below] != 0;
        r[c] = on_obstacle ? 1.0 : first ? end : (beneath >= 1.0 ? 1.0 : beneath * r[c + below]);
        const double excess = sign * (rho_s - mixture(a[c], rho_l, rho_g));
        if (excess <= 0.0) return;  // its grains press the other way
        const double bare = 1.0 - std::fmin(f[c - below] / packed, 1.0);
        const double weight = half * excess * r[c] * bare;
        out[c] = first || on_obstacle ? weight : std::fmin(weight, p[c + below] / packed);
      });
    }
  }
}

void extend_to_walls(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha,
                     Field& pressure) {
  const double rho_s = scene.solid.density, rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double *f = f_s.data(), *a = alpha.data();
  double* p = pressure.data();
  for (const bool upper : {false, true}) {
    if (!closed_end(grid, upper)) continue;
    const std::ptrdiff_t out = upper ? grid.stride(vertical) : -grid.stride(vertical);
    const double half = (upper ? -0.5 : 0.5) * normal_gravity(scene) * grid.h[vertical];
    const int j = upper ? grid.cells.n[vertical] - 1 : 0;
    for_each(grid.cells, row_of_cells(grid, j, 1), [=](std::ptrdiff_t c) {
      const double weight = half * f[c] * (rho_s - mixture(a[c], rho_l, rho_g));
      p[c + out] = p[c] + 2.0 * std::fmin(std::fmax(weight, 0.0), p[c]);
    });
  }
}

}  // namespace granvof
