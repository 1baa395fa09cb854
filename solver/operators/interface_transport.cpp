#include "solver/operators/interface_transport.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/operators/cicsam.hpp"
#include "solver/operators/flux_balance.hpp"

namespace granvof {
namespace {

constexpr double interface_courant = 0.2;  // outflow Courant number; CICSAM blurs and wrinkles as it grows
constexpr int most_substeps = 8;

}  // namespace

InterfaceTransport::InterfaceTransport(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      liquid_(grid),
      f_c_(grid),
      f_c_end_(grid),
      courant_(grid),
      gain_(grid),
      loss_(grid),
      slope_(grid),
      correction_(grid),
      passed_(grid) {
  if (scene.numerics.interface_scheme == InterfaceScheme::plic) plic_.emplace(grid, boundary);
}

// The outflow Courant number of every cell goes to courant_; only cells at the interface decide the division.
int InterfaceTransport::substeps(double dt, const Field& alpha, const Field& f_s, const FaceField& flux_c) {
  outflow_rate(grid_, flux_c, courant_);
  double* co = courant_.data();
  const double *f = f_s.data(), *a = alpha.data();
  const double largest = max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) {
    co[c] *= dt / (1.0 - f[c]);
    return a[c] > 1e-6 && a[c] < 1.0 - 1e-6 ? co[c] : 0.0;
  });
  const int parts = std::clamp(static_cast<int>(std::ceil(largest / interface_courant)), 1, most_substeps);
  for_each(grid_.cells, [=](std::ptrdiff_t c) { co[c] /= parts; });
  boundary_.fill_scalar(courant_);
  return parts;
}

void InterfaceTransport::interface_normal(const Field& alpha) {
  const double* a = alpha.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv = 0.5 / grid_.h[d];
    double* g = slope_[d].data();
    for_each(grid_.cells, [=](std::ptrdiff_t c) { g[c] = (a[c + s] - a[c - s]) * inv; });
    const InnerWalls& walls = boundary_.walls();
    std::array<int, 3> up{}, down{};
    up[d] = 1;
    down[d] = -1;
    for (const InnerWalls::Place& cell : walls.cells())
      g[cell.at] = (walls.cell_beside(a, cell.at, up) - walls.cell_beside(a, cell.at, down)) * inv;
    boundary_.fill_scalar(slope_[d]);
  }
}

void InterfaceTransport::face_alpha(int d, const Field& alpha, const FaceField& flux_c) {
  const double *a = alpha.data(), *q = flux_c[d].data(), *co = courant_.data();
  const double* gx = slope_[0].data();
  const double* gy = slope_[1].data();
  const double* gz = grid_.dim == 3 ? slope_[2].data() : nullptr;
  const double* gd = slope_[d].data();
  double* corr = correction_[d].data();
  const std::ptrdiff_t s = grid_.stride(d);
  const bool cicsam_on = scene_.numerics.interface_scheme == InterfaceScheme::cicsam;
  // of face c, with alpha by `values` along a stride, `at` the upper side of the face
  const auto correction = [=](std::ptrdiff_t c, const double* values, std::ptrdiff_t at, std::ptrdiff_t t) {
    const bool forward = q[c] > 0.0;
    const std::ptrdiff_t donor = forward ? c - s : c;
    const double of_donor = forward ? values[at - t] : values[at],
                 of_acceptor = forward ? values[at] : values[at - t];
    const double of_upwind = forward ? values[at - 2 * t] : values[at + t];
    if (!cicsam_on || of_donor == of_acceptor || q[c] == 0.0) return 0.0;
    const double square =
        gx[donor] * gx[donor] + gy[donor] * gy[donor] + (gz != nullptr ? gz[donor] * gz[donor] : 0.0);
    const double cosine_squared = square > 0.0 ? gd[donor] * gd[donor] / square : 1.0;
    const double face = cicsam_face_value(of_upwind, of_donor, of_acceptor, co[donor], cosine_squared);
    return (face - of_donor) * q[c];
  };
  const Range faces = grid_.fluid_faces(d);
  for_each(grid_.cells, faces, [=](std::ptrdiff_t c) { corr[c] = correction(c, a, c, s); });
  for (const InnerWalls::Place& beside : boundary_.walls().faces(d)) {
    if (!faces.contains(beside.place)) continue;
    const auto line = boundary_.walls().cells_across(a, beside.at, d);
    corr[beside.at] = correction(beside.at, line.data(), 2, 1);
  }
  boundary_.exchange(correction_[d]);
}

// Zalesak's limiter on the corrections: liquid_ holds the upwind result, which is within bounds.
void InterfaceTransport::limit_corrections(double dt, const Field& f_c_end) {
  double *gain = gain_.data(), *loss = loss_.data();
  const double *fl = liquid_.data(), *fc = f_c_end.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { gain[c] = loss[c] = 0.0; });
  for (int d = 0; d < grid_.dim; ++d) {
    const double* q = correction_[d].data();
    const std::ptrdiff_t s = grid_.stride(d);
    const double dt_h = dt / grid_.h[d];
    for_each(grid_.cells, [=](std::ptrdiff_t c) {
      gain[c] += dt_h * (std::max(q[c], 0.0) - std::min(q[c + s], 0.0));
      loss[c] += dt_h * (std::max(q[c + s], 0.0) - std::min(q[c], 0.0));
    });
  }
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    const double room = std::max(fc[c] - fl[c], 0.0), held = std::max(fl[c], 0.0);
    gain[c] = gain[c] > room ? room / gain[c] : 1.0;
    loss[c] = loss[c] > held ? held / loss[c] : 1.0;
  });
  boundary_.fill_scalar(gain_, 1.0);
  boundary_.fill_scalar(loss_, 1.0);
  for (int d = 0; d < grid_.dim; ++d) {
    double* q = correction_[d].data();
    const std::ptrdiff_t s = grid_.stride(d);
    for_each(grid_.cells, grid_.fluid_faces(d), [=](std::ptrdiff_t c) {
      q[c] *= q[c] > 0.0 ? std::min(loss[c - s], gain[c]) : std::min(loss[c], gain[c - s]);
    });
    boundary_.exchange(correction_[d]);
  }
}

void InterfaceTransport::substep(double dt, const FaceField& flux_c, Field& alpha, Field& f_c,
                                 Field& f_c_end) {
  boundary_.fill_liquid_share(alpha, flux_c);
  interface_normal(alpha);
  double *fl = liquid_.data(), *a = alpha.data(), *fc = f_c.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { fl[c] = a[c] * fc[c]; });
  subtract_upwind_divergence(grid_, dt, flux_c, alpha, liquid_);
  // What the fluxes leave, not 1 - f_s: the two differ by the continuity residual, and only with the former
  // is alpha bounded without clipping, which would lose the residual of every full cell.
  f_c_end = f_c;
  subtract_divergence(grid_, dt, flux_c, f_c_end);
  for (int d = 0; d < grid_.dim; ++d) face_alpha(d, alpha, flux_c);
  limit_corrections(dt, f_c_end);
  for (int d = 0; d < grid_.dim; ++d) {
    const double *q = flux_c[d].data(), *corr = correction_[d].data();
    double* liquid = passed_.through[d].data();
    const std::ptrdiff_t s = grid_.stride(d);
    for_each(grid_.cells, grid_.flux_faces(d),
             [=](std::ptrdiff_t c) { liquid[c] += dt * (q[c] * (q[c] > 0.0 ? a[c - s] : a[c]) + corr[c]); });
  }
  subtract_divergence(grid_, dt, correction_, liquid_);
  const double* fc_end = f_c_end.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    a[c] = std::clamp(fl[c] / fc_end[c], 0.0, 1.0);  // within bounds already but for rounding
    fc[c] = fc_end[c];
  });
}

const LiquidPassed& InterfaceTransport::advance(double dt, const Field& alpha, const Field& f_s,
                                                const FaceField& flux_c, Field& alpha_new) {
  passed_.clear(grid_);
  if (plic_) {
    plic_->advance(dt, alpha, f_s, flux_c, alpha_new, passed_);
    return passed_;
  }
  const int parts = substeps(dt, alpha, f_s, flux_c);
  alpha_new = alpha;
  const double* f = f_s.data();
  double* fc = f_c_.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { fc[c] = 1.0 - f[c]; });
  for (int part = 0; part < parts; ++part) substep(dt / parts, flux_c, alpha_new, f_c_, f_c_end_);
  return passed_;
}

}  // namespace granvof
