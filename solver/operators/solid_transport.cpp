#include "solver/operators/solid_transport.hpp"

#include <algorithm>
#include <cmath>

#include "solver/operators/flux_balance.hpp"
#include "solver/operators/mixture.hpp"

namespace granvof {
void keep_solid_positive(const Grid& grid, const Boundary& boundary, double dt, const Field& f_s,
                         FaceField& flux_s, FaceField& flux_c) {
  Field share(grid, 1.0);
  outflow_rate(grid, flux_s, share);
  const double* f = f_s.data();
  double* r = share.data();
  const double least = -max_over(grid.cells, grid.all_cells(), -1.0, [=](std::ptrdiff_t c) {
    const double out = dt * r[c];
    const double held = std::max(f[c], 0.0);  // an emptied cell may hold minus one rounding error
    r[c] = out > held ? held / out : 1.0;
    return -r[c];
  });
  if (least >= 1.0) return;
  boundary.fill_scalar(share);
  for (int d = 0; d < grid.dim; ++d) {
    double *qs = flux_s[d].data(), *qc = flux_c[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    for_each(grid.cells, grid.flux_faces(d), [=](std::ptrdiff_t c) {
      const double kept = qs[c] * (qs[c] > 0.0 ? r[c - s] : r[c]);
      qc[c] += qs[c] - kept;
      qs[c] = kept;
    });
    boundary.exchange(flux_s[d]);
    boundary.exchange(flux_c[d]);
  }
}

void transport_solid(const Grid& grid, double dt, const Field& f_s, const FaceField& flux_s, Field& f_s_new) {
  f_s_new = f_s;
  subtract_divergence(grid, dt, flux_s, f_s_new);
}

double solid_left(const Grid& grid, double dt, const FaceField& flux_s) {
  double left = 0.0;
  grid.for_each_open_side([&](int d, bool upper) {
    const double* q = flux_s[d].data();
    left += (upper ? dt : -dt) * grid.cell_volume / grid.h[d] *
            sum_over(grid.cells, grid.side_faces(d, upper), [=](std::ptrdiff_t c) { return q[c]; });
  });
  return left;
}

void transport_with_grains(const Grid& grid, double dt, const Field& f_s, const Field& f_s_new,
                           const FaceField& flux_s, const Field& phi, Field& phi_new) {
  const double *f = f_s.data(), *f_new = f_s_new.data(), *p = phi.data();
  double* out = phi_new.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] = f[c] * p[c]; });
  subtract_upwind_divergence(grid, dt, flux_s, phi, phi_new);
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    out[c] = f_new[c] > least_solid_fraction ? std::clamp(out[c] / f_new[c], 0.0, 1.0) : p[c];
  });
}

double outflow_courant(const Grid& grid, double dt, const Field& fraction, bool complement, double least,
                       const FaceField& flux) {
  Field total(grid);
  outflow_rate(grid, flux, total);
  const double* f = fraction.data();
  const double* out = total.data();
  return max_over(grid.cells, grid.all_cells(), 0.0, [=](std::ptrdiff_t c) {
    const double held = complement ? 1.0 - f[c] : f[c];
    return held > least ? dt * out[c] / held : 0.0;
  });
}

}  // namespace granvof
