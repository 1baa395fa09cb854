// P_s(f_s) within the Newton iteration on the coupled pressures: where it is linearised, how far a solution
// is off it, and P_s where no grains are that it moves.
#include <algorithm>
#include <cmath>

#include "solver/closures/point_on_law.hpp"
#include "solver/operators/coupled_pressure.hpp"
#include "solver/operators/flux_balance.hpp"

namespace granvof {
namespace {

// Grains do not pull. The solution of the linearised law may: a bed that opens within the step leaves P_lin
// far below zero where the law says 0. Only as much tension as this share of the bed's load passes for none;
// a layer of grains weighs ten times that.
constexpr double tension_that_matters = 1e-3;
// A mismatch of P_s counts as a solid fraction through the slope of the law, but not below this slope, in
// loads of the bed: where grains do not touch, a pressure error of volume_tolerance times this is
// meaningless.
constexpr double slope_that_matters = 10.0;
// Least slope of the law that a cell is linearised with, in loads of the bed: keeps the step regular where
// there are no grains.
constexpr double least_slope = 1e-3;

// P_s(f_s) of a cell at a trial f_s and the packing of the step; Theta, e and what else fixes the law are
// those of the old level.
auto law_of_cells(const State& now, const Field& packing_of_step, const Rheology& rheology,
                  const closures::SolidLaw& law_of_scene) {
  const double *theta = now.theta.data(), *e = rheology.restitution.data(),
               *rest = rheology.part_cells.resting.data(), *packing = packing_of_step.data();
  const double* viscous = rheology.viscous_stress.empty() ? nullptr : rheology.viscous_stress.data();
  return [=, law = law_of_scene](std::ptrdiff_t c, double f) {
    return closures::solid_pressure(f, {theta[c], e[c], rest[c], packing[c], viscous ? viscous[c] : 0.0},
                                    law);
  };
}

}  // namespace

// First linearisation points: where the velocities of the old level would take f_s. One Newton iteration in
// six is saved over the old f_s itself.
void CoupledPressure::extrapolate_points(double dt, const Field& f_s, const FaceField& u_s_old) {
  const double* old = f_s.data();
  double* f = point_f_.data();
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) { f[c] = old[c]; });
  for (int d = 0; d < grid_.dim; ++d) {
    const Range faces = pushed_faces(d);
    fraction_.face_values(grid_, boundary_.walls(), f_s, u_s_old[d], d, dt, faces, f_upwind_s_[d]);
    const double *phi = f_upwind_s_[d].data(), *u = u_s_old[d].data();
    us_[d].fill(0.0);  // also on sides that nothing passes
    double* flux = us_[d].data();
    for_each(grid_.cells, faces, [=](std::ptrdiff_t c) { flux[c] = phi[c] * u[c]; });
    boundary_.exchange(us_[d]);
  }
  subtract_divergence(grid_, dt, us_, pushed_, point_f_);
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) { f[c] = std::max(f[c], 0.0); });
}

// Takes the law P_s(f_s) and its slope at the linearisation points.
void CoupledPressure::linearise(const State& now, const Field& packing, const Rheology& rheology) {
  const double* pf = point_f_.data();
  double *pp = point_p_.data(), *slope = slope_.data();
  const bool implicit = is_implicit();
  const double least = least_slope * load_;
  const auto pressure = law_of_cells(now, packing, rheology, law_);
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) {
    const auto p = pressure(c, pf[c]);
    pp[c] = p.value;
    slope[c] = implicit ? std::max(p.slope, least) : least;  // next to none: P_s stays at the point
  });
}

// Distance of the present solution from the law; moves the linearisation points towards it.
//
// A cell where the solution (f_new, P_lin) is off the law gets as its next point the state its own balance
// would take if its neighbours stayed: f + B P_s(f) = f_new + B P_lin, B = what a unit of P_s drives out of
// the cell in dt. That line is flat for a loaded bed (the weight fixes P_s) and steep for grains being driven
// together (the motion fixes f_s); tangents alone creep along the law, which grows like (f_s - f_s,min)^3.5.
double CoupledPressure::move_points(double dt, const State& now, const Field& packing,
                                    const Rheology& rheology) {
  const double *dp = dp_s_.data(), *p_old = now.p_s.data(), *f_new = f_new_.data();
  double *pf = point_f_.data(), *pp = point_p_.data(), *slope = slope_.data();
  const double tolerance = scene_.numerics.volume_tolerance;
  const auto pressure = law_of_cells(now, packing, rheology, law_);
  std::array<const double*, 3> k22{};
  for (int d = 0; d < grid_.dim; ++d) k22[d] = k22_[d].data();
  const auto stride = grid_.cells.stride;
  const int dim = grid_.dim;
  const double tension = tension_that_matters * load_, steep = slope_that_matters * load_,
               least = least_slope * load_;
  return max_over(grid_.cells, pushed_, 0.0, [=](std::ptrdiff_t c) {
    const auto p_at = [&](double f) { return pressure(c, f); };
    const double p_lin = p_old[c] + dp[c];
    auto there = p_at(std::max(f_new[c], 0.0));
    const double p_felt = p_lin < -tension ? p_lin : std::max(p_lin, 0.0);
    const double off = std::fabs(there.value - p_felt) / std::max(there.slope, steep);
    pf[c] = std::max(f_new[c], 0.0);
    if (off > tolerance) {
      double compliance = 0.0;
      for (int d = 0; d < dim; ++d) compliance += k22[d][c] + k22[d][c + stride[d]];
      pf[c] = closures::point_on_law(p_at, f_new[c], p_lin, compliance * dt);
      there = p_at(pf[c]);
    }
    pp[c] = there.value;
    slope[c] = std::max(there.slope, least);
    return off;
  });
}

// The new pressures. Where P_s moves nothing it is that of the law where the fluxes lead.
void CoupledPressure::set_pressures(double dt, const State& now, const Rheology& rheology,
                                    const FaceField& flux_s, State& next) {
  const double *dpc = dp_c_.data(), *dps = dp_s_.data();
  double *pc = next.p_c.data(), *ps = next.p_s.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { pc[c] += dpc[c]; });
  for_each(grid_.cells, pushed_, [=](std::ptrdiff_t c) { ps[c] = std::max(ps[c] + dps[c], 0.0); });
  if (!holds_grains_) return next.p_s.fill(0.0);
  const bool implicit = is_implicit();
  const double* old = now.f_s.data();
  double* f = f_new_.data();
  const auto pressure = law_of_cells(now, next.packing, rheology, law_);
  for_each_part_outside(grid_.all_cells(), pushed_, [&](const Range& cells) {
    for_each(grid_.cells, cells, [=](std::ptrdiff_t c) { f[c] = old[c]; });
    if (implicit) subtract_divergence(grid_, dt, flux_s, cells, f_new_);
    for_each(grid_.cells, cells, [=](std::ptrdiff_t c) { ps[c] = pressure(c, std::max(f[c], 0.0)).value; });
  });
}

}  // namespace granvof
