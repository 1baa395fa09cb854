#include "solver/operators/solid_transport.hpp"

#include <algorithm>
#include <cmath>

#include "solver/operators/mixture.hpp"

namespace granvof {
namespace {

// Outflow of cell c per volume [1/s], summed over its faces.
inline double outflow(const double* flux, std::ptrdiff_t c, std::ptrdiff_t s, double inv_h) {
  return inv_h * (std::fmax(flux[c + s], 0.0) - std::fmin(flux[c], 0.0));
}

void add_outflow(const Grid& grid, const FaceField& flux, Field& total) {
  double* out = total.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] = 0.0; });
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double inv_h = 1.0 / grid.h[d];
    for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] += outflow(q, c, s, inv_h); });
  }
}

}  // namespace

void keep_solid_positive(const Grid& grid, const Boundary& boundary, double dt, const Field& f_s,
                         FaceField& flux_s, FaceField& flux_c) {
  Field share(grid, 1.0);
  add_outflow(grid, flux_s, share);
  const double* f = f_s.data();
  double* r = share.data();
  const double least = -max_over(grid.cells, grid.all_cells(), -1.0, [=](std::ptrdiff_t c) {
    const double out = dt * r[c];
    const double held = std::fmax(f[c], 0.0);  // an emptied cell may hold minus one rounding error
    r[c] = out > held ? held / out : 1.0;
    return -r[c];
  });
  if (least >= 1.0) return;
  boundary.fill_scalar(share);
  for (int d = 0; d < grid.dim; ++d) {
    double *qs = flux_s[d].data(), *qc = flux_c[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    for_each(grid.cells, grid.inner_faces(d), [=](std::ptrdiff_t c) {
      const double kept = qs[c] * (qs[c] > 0.0 ? r[c - s] : r[c]);
      qc[c] += qs[c] - kept;
      qs[c] = kept;
    });
    boundary.exchange(flux_s[d]);
    boundary.exchange(flux_c[d]);
  }
}

void transport_solid(const Grid& grid, double dt, const Field& f_s, const FaceField& flux_s, Field& f_s_new) {
  const double* f = f_s.data();
  double* out = f_s_new.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] = f[c]; });
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux_s[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double dt_h = dt / grid.h[d];
    for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] -= dt_h * (q[c + s] - q[c]); });
  }
}

void transport_colour(const Grid& grid, double dt, const Field& f_s, const Field& f_s_new,
                      const FaceField& flux_s, const Field& phi, Field& phi_new) {
  const double *f = f_s.data(), *f_new = f_s_new.data(), *p = phi.data();
  double* out = phi_new.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { out[c] = f[c] * p[c]; });
  for (int d = 0; d < grid.dim; ++d) {
    const double* q = flux_s[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double dt_h = dt / grid.h[d];
    for_each(grid.cells, [=](std::ptrdiff_t c) {
      const double ahead = q[c + s] * (q[c + s] > 0.0 ? p[c] : p[c + s]);
      const double behind = q[c] * (q[c] > 0.0 ? p[c - s] : p[c]);
      out[c] -= dt_h * (ahead - behind);
    });
  }
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    out[c] = f_new[c] > least_solid_fraction ? std::clamp(out[c] / f_new[c], 0.0, 1.0) : p[c];
  });
}

double outflow_courant(const Grid& grid, double dt, const Field& fraction, bool complement, double least,
                       const FaceField& flux) {
  Field total(grid);
  add_outflow(grid, flux, total);
  const double* f = fraction.data();
  const double* out = total.data();
  return max_over(grid.cells, grid.all_cells(), 0.0, [=](std::ptrdiff_t c) {
    const double held = complement ? 1.0 - f[c] : f[c];
    return held > least ? dt * out[c] / held : 0.0;
  });
}

}  // namespace granvof
