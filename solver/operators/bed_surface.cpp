#include "solver/operators/bed_surface.hpp"

#include <algorithm>
#include <cmath>

#include "solver/operators/mixture.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

// Gap of a cell to the least packing, as a share of that, through which grains above fall into it.
constexpr double gap_that_yields = 0.05;
// Grains above a free face, as a share of those below it, from which on they fall on it unhindered.
constexpr double falling_that_frees = 0.05;

// 0 up to 0.9 of `end`, 1 from there on.
double ramp(double x, double end) {
  return std::clamp(10.0 * x / end - 9.0, 0.0, 1.0);
}

Range row_of_cells(const Grid& grid, int j, int ghosts) {
  Range row = grid.cells_and_ghosts(ghosts);
  row.lower[vertical] = j;
  row.upper[vertical] = j + 1;
  return row;
}

}  // namespace

void PartCells::update(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha,
                       const Field& p_s) {
  const double rho_s = scene.solid.density, rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double packed = scene.contact.solid_fraction_min;
  const double half = 0.5 * normal_gravity(scene) * grid.h[vertical];
  const double *f = f_s.data(), *a = alpha.data(), *p = p_s.data();
  double *pressure = resting.data(), *rest = at_rest.data(), *hold = held.data(), *r = support_.data();
  resting.fill(0.0);
  at_rest.fill(0.0);
  held.fill(0.0);
  const int n = grid.cells.n[vertical];
  const char* solid = grid.obstacles.solid();
  for (const bool light : {false, true}) {
    if (light ? rho_s >= std::max(rho_l, rho_g) : rho_s <= std::min(rho_l, rho_g)) continue;
    const std::ptrdiff_t below = light ? grid.stride(vertical) : -grid.stride(vertical);
    const double sign = light ? -1.0 : 1.0;
    const double end = grid.side(vertical, light).bears_grains ? 1.0 : 0.0;
    const SideRule& far = grid.side(vertical, !light);
    const bool closed = !far.joined && !far.solid_fraction && !far.passes_grains;
    for (int step = 0; step < n; ++step) {
      const bool first = step == 0, nothing_above = closed && step == n - 1;
      for_each(grid.cells, row_of_cells(grid, light ? n - 1 - step : step, 0), [=](std::ptrdiff_t c) {
        const std::ptrdiff_t b = c + below, above = c - below;
        const double over = nothing_above ? 0.0 : f[above];
        const double own = std::min(f[c], packed), bare = own - over;
        const double excess = sign * (rho_s - mixture(a[c], rho_l, rho_g));
        const bool on_obstacle = solid != nullptr && !first && solid[b] != 0;
        r[c] = first         ? end
               : on_obstacle ? 1.0
                             : std::max(1.0 - ramp(packed - f[b], gap_that_yields * packed), hold[b] * r[b]);
        // none; they press the other way; or they carry others
        if (own < least_solid_fraction || excess <= 0.0 || bare <= 0.0) return;
        hold[c] = 1.0 - ramp(over, falling_that_frees * own);
        const double weight = half * excess * bare * r[c];
        const double borne = first || on_obstacle ? weight : std::min(weight, p[b]);
        pressure[c] = borne;
        rest[c] = sign * borne / (half * excess);
      });
    }
  }
}

void set_half_weights(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha,
                      Field& weight) {
  const double rho_s = scene.solid.density, rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double half = 0.5 * normal_gravity(scene) * grid.h[vertical];
  const double *f = f_s.data(), *a = alpha.data();
  double* w = weight.data();
  for_each(grid.cells, grid.cells_and_ghosts(1),
           [=](std::ptrdiff_t c) { w[c] = half * f[c] * (rho_s - mixture(a[c], rho_l, rho_g)); });
}

void extend_to_walls(const Grid& grid, const Field& half_weight, Field& pressure) {
  const double* w = half_weight.data();
  double* p = pressure.data();
  for (const bool upper : {false, true}) {
    if (!grid.side(vertical, upper).bears_grains) continue;
    const std::ptrdiff_t out = upper ? grid.stride(vertical) : -grid.stride(vertical);
    const double towards = upper ? -1.0 : 1.0;
    for_each(grid.cells, row_of_cells(grid, upper ? grid.cells.n[vertical] : -1, 1), [=](std::ptrdiff_t b) {
      p[b] = p[b - out] + 2.0 * borne_by_wall(p[b - out], towards * w[b - out]);
    });
  }
}

}  // namespace granvof
