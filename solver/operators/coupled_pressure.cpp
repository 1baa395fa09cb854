#include "solver/operators/coupled_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "solver/operators/flux_balance.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr int most_linear_iterations = 200;
// Iteration from which the upwind directions are kept, until all else is solved.
constexpr int upwinding_settles = 4;
// Volume, as a fraction of a cell, that a face may carry with the fraction of the wrong side. A bed that a
// step sets in motion outward starts with the fraction of the empty side: no volume leaves it, nothing but
// its inertia resists, and one iteration "converges" with a face at 100 m/s.
constexpr double turned_flux_that_matters = 1e-3;
// Of volume_tolerance: a first guess that leaves less is solved; what rounding leaves is a hundred times
// less. One that merely is within the tolerance is an explicit step of the pressure: pools at rest, whose
// steps all passed so, had waves grow from rounding to what the tolerance allows, 1e-5 m/s in the water and
// 2e-3 in the air.
constexpr double nothing_left = 1e-5;

}  // namespace

CoupledPressure::CoupledPressure(const Grid& grid, const Scene& scene, const Boundary& boundary,
                                 const closures::SolidLaw& law)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      law_(law),
      load_(scales_of(scene).pressure),
      solver_(grid.cells, grid.h),
      fraction_(scene.numerics.transport_scheme),
      us_by_pc_(grid),
      us_by_ps_(grid),
      uc_by_pc_(grid),
      uc_by_ps_(grid),
      k11_(grid),
      k12_(grid),
      k21_(grid),
      k22_(grid),
      f_upwind_s_(grid),
      f_upwind_c_(grid),
      us_(grid),
      uc_(grid),
      m11_(grid),
      m22_(grid),
      rhs1_(grid),
      rhs2_(grid),
      dp_c_(grid),
      dp_s_(grid),
      point_f_(grid),
      point_p_(grid),
      slope_(grid),
      f_new_(grid),
      present_(grid) {}

// Solid fraction of a face below which P_s does not push its grains.
double CoupledPressure::least_pushed() const {
  // With the explicit law no cell's P_s answers to what fills it within the step.
  return is_implicit() ? solid_that_counts : least_solid_fraction;
}

// Faces of the cells with a second row.
Range CoupledPressure::pushed_faces(int d) const {
  return common(faces_of(pushed_, d), grid_.flux_faces(d));
}

// Response of both velocities to both pressure increments on every face:
//   m_s du_s = -f_s grad dP_c - grad dP_s - beta (du_s - du_c),  m_c du_c = -f_c grad dP_c + beta (du_s -
//   du_c),
// m = (phase mass) / dt. Where a face holds no grains both phases move as one.
void CoupledPressure::set_response(double dt, const FaceInertia& inertia, const FaceField& beta,
                                   const Aperture& aperture) {
  const double least = least_pushed();
  for (int d = 0; d < grid_.dim; ++d) {
    const double* f = inertia.f_s[d].data();
    const double* solid = inertia.solid[d].data();
    const double* fluid = inertia.fluid[d].data();
    const double* b = beta[d].data();
    const double* open = aperture[d].data();
    double *s_c = us_by_pc_[d].data(), *s_s = us_by_ps_[d].data();
    double *c_c = uc_by_pc_[d].data(), *c_s = uc_by_ps_[d].data();
    for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t i) {
      const double f_s = f[i], f_c = 1.0 - f_s;
      const double m_s = solid[i] / dt, m_c = fluid[i] / dt;
      const bool grains = f_s >= least_solid_fraction;
      const double together = open[i] / (m_s + m_c);
      const double inv_det = open[i] / (grains ? m_s * m_c + b[i] * (m_s + m_c) : 1.0);
      s_c[i] = grains ? inv_det * ((m_c + b[i]) * f_s + b[i] * f_c) : together;
      const bool pushed = f_s >= least;
      s_s[i] = pushed ? inv_det * (m_c + b[i]) : 0.0;
      c_c[i] = grains ? inv_det * (b[i] * f_s + (m_s + b[i]) * f_c) : together;
      c_s[i] = pushed ? inv_det * b[i] : 0.0;
    });
    for (const bool upper : {false, true}) {
      // the fluid passes, the velocity of grains is given
      if (!grid_.side(d, upper).passes_fluid) continue;
      for_each(grid_.cells, grid_.side_faces(d, upper), [=](std::ptrdiff_t i) {
        const double f_c = 1.0 - f[i];
        c_c[i] = open[i] * f_c / (fluid[i] / dt + (f[i] >= least_solid_fraction ? b[i] : 0.0));
        s_c[i] = s_s[i] = c_s[i] = 0.0;
      });
    }
    boundary_.exchange(us_by_pc_[d]);
    boundary_.exchange(us_by_ps_[d]);
    boundary_.exchange(uc_by_pc_[d]);
    boundary_.exchange(uc_by_ps_[d]);
  }
}

// Fractions the fluxes carry, for the present directions of flow, and the flux response K of every face.
void CoupledPressure::set_fluxes(double dt, const Field& f_s, bool new_directions) {
  for (int d = 0; d < grid_.dim; ++d) {
    const Range faces = grid_.flux_faces(d);
    if (new_directions && holds_grains_) {
      fraction_.face_values(grid_, boundary_.walls(), f_s, us_[d], d, dt, faces, f_upwind_s_[d]);
      fraction_.face_values(grid_, boundary_.walls(), f_s, uc_[d], d, dt, faces, f_upwind_c_[d]);
      boundary_.exchange(f_upwind_s_[d]);
      boundary_.exchange(f_upwind_c_[d]);
    }
    const double inv_h2 = 1.0 / (grid_.h[d] * grid_.h[d]);
    const double *phi_s = f_upwind_s_[d].data(), *phi_c = f_upwind_c_[d].data();
    const double *s_c = us_by_pc_[d].data(), *s_s = us_by_ps_[d].data();
    const double *c_c = uc_by_pc_[d].data(), *c_s = uc_by_ps_[d].data();
    double *k11 = k11_[d].data(), *k12 = k12_[d].data(), *k21 = k21_[d].data(), *k22 = k22_[d].data();
    for_each(grid_.cells, faces,
             [=](std::ptrdiff_t i) { k11[i] = inv_h2 * (phi_s[i] * s_c[i] + (1.0 - phi_c[i]) * c_c[i]); });
    for_each(grid_.cells, pushed_faces(d), [=](std::ptrdiff_t i) {
      k21[i] = inv_h2 * phi_s[i] * s_c[i];
      k22[i] = inv_h2 * phi_s[i] * s_s[i];
      k12[i] = k22[i] + inv_h2 * (1.0 - phi_c[i]) * c_s[i];
    });
    for (FaceField* k : {&k11_, &k12_, &k21_, &k22_}) boundary_.exchange((*k)[d]);
  }
}

// Right-hand sides of continuity and of the linearised solid balance
//   f* + (P_s - P*) / J = f^n - dt div(f_s u_s), with u = predicted velocities.
void CoupledPressure::set_balances(double dt, const Field& f_s, const Field& p_s,
                                   const FaceField& us_predicted, const FaceField& uc_predicted) {
  double *r1 = rhs1_.data(), *r2 = rhs2_.data(), *m1 = m11_.data(), *m2 = m22_.data();
  const double *f = f_s.data(), *p = p_s.data();
  const double *pf = point_f_.data(), *pp = point_p_.data(), *slope = slope_.data();
  const double inv_dt = 1.0 / dt;
  for_each(grid_.cells, [=](std::ptrdiff_t c) { m1[c] = r1[c] = 0.0; });
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) {
    m2[c] = inv_dt / slope[c];
    r2[c] = (f[c] - pf[c]) * inv_dt + (pp[c] - p[c]) * m2[c];
  });
  for (int d = 0; d < grid_.dim; ++d) {
    const double *phi_s = f_upwind_s_[d].data(), *phi_c = f_upwind_c_[d].data();
    const double *us = us_predicted[d].data(), *uc = uc_predicted[d].data();
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    for_each(grid_.cells, [=](std::ptrdiff_t c) {
      const double solid = (phi_s[c + s] * us[c + s] - phi_s[c] * us[c]) * inv_h;
      const double fluid = ((1.0 - phi_c[c + s]) * uc[c + s] - (1.0 - phi_c[c]) * uc[c]) * inv_h;
      r1[c] -= solid + fluid;
    });
    for_each(grid_.cells, pushed_,
             [=](std::ptrdiff_t c) { r2[c] -= (phi_s[c + s] * us[c + s] - phi_s[c] * us[c]) * inv_h; });
  }
  for (int d = 0; d < grid_.dim; ++d) {
    for (const bool upper : {false, true}) {
      // P_c is given half a cell beyond the outermost cells: twice the face coefficient to a known zero
      if (!grid_.side(d, upper).passes_fluid) continue;
      double* k11 = k11_[d].data();
      const std::ptrdiff_t face = upper ? grid_.stride(d) : 0;
      for_each(grid_.cells, grid_.side_cells(d, upper), [=](std::ptrdiff_t c) {
        m1[c] += 2.0 * k11[c + face];
        k11[c + face] = 0.0;  // the solver takes no neighbour beyond a side
      });
    }
  }
}

// Velocities from the increments, fluxes, and the solid fraction that the fluxes lead to where P_s moves.
void CoupledPressure::correct(double dt, const Field& f_s, const FaceField& us_predicted,
                              const FaceField& uc_predicted, FaceField& flux_s, FaceField& flux_c) {
  boundary_.fill_pressure_increment(dp_c_);
  boundary_.fill_scalar(dp_s_);
  const double *pc = dp_c_.data(), *ps = dp_s_.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    const double *s_c = us_by_pc_[d].data(), *s_s = us_by_ps_[d].data();
    const double *c_c = uc_by_pc_[d].data(), *c_s = uc_by_ps_[d].data();
    const double *us_p = us_predicted[d].data(), *uc_p = uc_predicted[d].data();
    const double *phi_s = f_upwind_s_[d].data(), *phi_c = f_upwind_c_[d].data();
    double *us = us_[d].data(), *uc = uc_[d].data(), *fs = flux_s[d].data(), *fc = flux_c[d].data();
    for_each(grid_.cells, grid_.flux_faces(d), [=](std::ptrdiff_t c) {
      const double grad_c = (pc[c] - pc[c - s]) * inv_h;
      us[c] = us_p[c] - s_c[c] * grad_c;
      uc[c] = uc_p[c] - c_c[c] * grad_c;
      fs[c] = phi_s[c] * us[c];
      fc[c] = (1.0 - phi_c[c]) * uc[c];
    });
    for_each(grid_.cells, pushed_faces(d), [=](std::ptrdiff_t c) {
      const double grad_s = (ps[c] - ps[c - s]) * inv_h;
      us[c] -= s_s[c] * grad_s;
      uc[c] -= c_s[c] * grad_s;
      fs[c] = phi_s[c] * us[c];
      fc[c] = (1.0 - phi_c[c]) * uc[c];
    });
    boundary_.exchange(us_[d]);
    boundary_.exchange(uc_[d]);
    boundary_.exchange(flux_s[d]);
    boundary_.exchange(flux_c[d]);
  }
  const double* f = f_s.data();
  double* f_new = f_new_.data();
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) { f_new[c] = f[c]; });
  subtract_divergence(grid_, dt, flux_s, pushed_, f_new_);
}

// Largest volume, as a fraction of a cell, by which the fluxes differ from those whose fractions are taken by
// the present directions of flow.
double CoupledPressure::turned_flux(double dt, const Field& f_s) {
  if (!holds_grains_) return 0.0;
  double largest = 0.0;
  for (int d = 0; d < grid_.dim; ++d) {
    const double dt_h = dt / grid_.h[d];
    const auto look = [&](const FaceField& velocity, const FaceField& taken, const Range& faces) {
      fraction_.face_values(grid_, boundary_.walls(), f_s, velocity[d], d, dt, faces, present_);
      const double *u = velocity[d].data(), *used = taken[d].data(), *present = present_.data();
      largest = max_over(grid_.cells, faces, largest,
                         [=](std::ptrdiff_t c) { return std::fabs((present[c] - used[c]) * u[c]) * dt_h; });
    };
    look(us_, f_upwind_s_, grid_.inner_faces(d));
    look(uc_, f_upwind_c_, grid_.fluid_faces(d));
  }
  return largest;
}

linear::CoupledSystem CoupledPressure::system() const {
  linear::CoupledSystem system{};
  for (int d = 0; d < grid_.dim; ++d) {
    system.k11[d] = k11_[d].data();
    system.k12[d] = k12_[d].data();
    system.k21[d] = k21_[d].data();
    system.k22[d] = k22_[d].data();
  }
  system.m11 = m11_.data();
  system.m22 = m22_.data();
  system.rhs1 = rhs1_.data();
  system.rhs2 = rhs2_.data();
  system.second = pushed_;
  return system;
}

PressureReport CoupledPressure::solve(double dt, const State& now, const Rheology& rheology,
                                      const FaceInertia& inertia, const FaceField& beta,
                                      const Aperture& aperture, State& next, FaceField& flux_s,
                                      FaceField& flux_c) {
  const Numerics& numerics = scene_.numerics;
  const bool implicit = is_implicit();
  PressureReport report;
  holds_grains_ = inertia.holds_grains;
  pushed_ = box_of_grains(grid_, inertia, least_pushed());
  if (!holds_grains_) {
    for (FaceField* fraction : {&f_upwind_s_, &f_upwind_c_})
      for (int d = 0; d < grid_.dim; ++d) (*fraction)[d].fill(0.0);
  }
  if (implicit) {
    extrapolate_points(dt, now.f_s, now.u_s);
  } else {
    point_f_ = now.f_s;  // P_s is that of the old solid fraction
  }
  us_ = next.u_s;
  uc_ = next.u_c;
  dp_c_.fill(0.0);
  dp_s_.fill(0.0);
  set_response(dt, inertia, beta, aperture);
  linearise(now, next.packing, rheology);
  bool turned = false;  // all is solved but for faces that carry the fraction of the wrong side
  for (int iteration = 0; iteration < numerics.newton_max; ++iteration) {
    set_fluxes(dt, now.f_s, iteration < upwinding_settles || turned);
    set_balances(dt, now.f_s, now.p_s, next.u_s, next.u_c);
    const auto solve_to = [&](double volume) {
      return solver_.solve(system(), dp_c_.data(), dp_s_.data(),
                           {volume / dt, numerics.linear_tolerance, most_linear_iterations});
    };
    linear::Report r = solve_to(numerics.volume_tolerance);
    if (iteration == 0 && r.iterations == 0) r = solve_to(nothing_left * numerics.volume_tolerance);
    report.newton = iteration + 1;
    report.linear += r.iterations;
    correct(dt, now.f_s, next.u_s, next.u_c, flux_s, flux_c);
    report.mismatch = implicit ? move_points(dt, now, next.packing, rheology) : 0.0;
    report.divergence = r.final * dt;
    if (!std::isfinite(report.mismatch)) return report;
    const bool solved =
        report.divergence <= numerics.volume_tolerance && report.mismatch <= numerics.volume_tolerance;
    turned = solved && !(turned_flux(dt, now.f_s) <= turned_flux_that_matters);
    report.converged = solved && !turned;
    if (report.converged) break;
  }
  std::swap(next.u_s, us_);
  std::swap(next.u_c, uc_);
  set_pressures(dt, now, rheology, flux_s, next);
  return report;
}

}  // namespace granvof
