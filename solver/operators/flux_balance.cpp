#include "solver/operators/flux_balance.hpp"

#include <algorithm>
#include <cmath>

namespace granvof {

void subtract_divergence(const Grid& grid, double dt, const FaceField& flux, const Range& cells,
                         Field& content) {
  double* out = content.data();
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double dt_h = dt / grid.h[d];
    for_each(grid.cells, cells, [=](std::ptrdiff_t c) { out[c] -= dt_h * (q[c + s] - q[c]); });
  }
}

void subtract_divergence(const Grid& grid, double dt, const FaceField& flux, Field& content) {
  subtract_divergence(grid, dt, flux, grid.all_cells(), content);
}

void subtract_upwind_divergence(const Grid& grid, double dt, const FaceField& flux, const Field& value,
                                const Range& cells, Field& content) {
  const double* v = value.data();
  double* out = content.data();
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double dt_h = dt / grid.h[d];
    for_each(grid.cells, cells, [=](std::ptrdiff_t c) {
      const double own = v[c], upper = v[c + s], lower = v[c - s], out_flux = q[c + s], in_flux = q[c];
      const double ahead = out_flux * (out_flux > 0.0 ? own : upper);
      const double behind = in_flux * (in_flux > 0.0 ? lower : own);
      out[c] -= dt_h * (ahead - behind);
    });
  }
}

void subtract_upwind_divergence(const Grid& grid, double dt, const FaceField& flux, const Field& value,
                                Field& content) {
  subtract_upwind_divergence(grid, dt, flux, value, grid.all_cells(), content);
}

void outflow_rate(const Grid& grid, const FaceField& flux, Field& rate) {
  double* out = rate.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] = 0.0; });
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double inv_h = 1.0 / grid.h[d];
    for_each(grid.cells,
             [=](std::ptrdiff_t c) { out[c] += inv_h * (std::max(q[c + s], 0.0) - std::min(q[c], 0.0)); });
  }
}

}  // namespace granvof
