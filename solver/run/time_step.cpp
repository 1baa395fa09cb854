#include "solver/run/time_step.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/operators/continuity_closure.hpp"
#include "solver/operators/convection.hpp"
#include "solver/operators/packing.hpp"
#include "solver/operators/pressure_level.hpp"
#include "solver/operators/solid_transport.hpp"
#include "solver/run/step_control.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

constexpr double largest_outflow = 0.95;  // share of a cell's content that may leave it in one step
constexpr double explicit_viscous_number =
    0.4;  // nu dt sum(1/h^2); explicit diffusion is unstable from 0.5 on
constexpr double largest_solid_fraction = 0.66;  // beyond it the step's packing is not to be trusted

}  // namespace

TimeStep::TimeStep(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      aperture_(grid, scene),
      inertia_(grid),
      drag_(grid, scene),
      rheology_(grid),
      viscosity_(grid, scene),
      friction_(grid, scene, boundary),
      pressure_(grid, scene, boundary),
      interface_(grid, scene, boundary),
      temperature_(grid, scene, boundary),
      strain_(grid),
      whole_columns_(grid.has_whole_columns()),
      continuity_tree_(grid),
      budget_(grid, scene, boundary),
      predicted_s_(grid),
      predicted_c_(grid),
      convective_c_(grid),
      mass_(grid),
      rhs_(grid),
      flux_s_(grid),
      flux_c_(grid),
      flux_c_solved_(grid),
      stirred_(grid),
      production_(grid) {
  if (!whole_columns_) continuity_tree_.grow(aperture_);
}

StepReport TimeStep::advance(const State& now, double dt, State& next, const BodyAcceleration* extra) {
  StepReport report;
  next = now;
  next.time = now.time + dt;
  if (aperture_.update(next.time) && !whole_columns_) continuity_tree_.grow(aperture_);

  cost_.time("closures", [&] {
    inertia_.update(grid_, scene_, now.f_s, now.alpha);
    if (scene_.model.viscous_contact_pressure) strain_.update(grid_, now.u_strain);
    rheology_.update(grid_, scene_, boundary_, now.f_s, now.theta, now.alpha, now.p_s, now.packing, strain_);
    drag_.update(boundary_, now.u_s, now.u_c, now.f_s, now.alpha, inertia_, rheology_.part_cells);
    stir_grains(now, dt);
  });
  cost_.time("predictor", [&] { predict(now, dt); });
  if (extra != nullptr) add_to_predictor(*extra, dt);
  if (!std::isfinite(kinematic_viscosity_)) {
    report.refused_because = "the viscosity of the fluid is not finite";
    report.not_finite = true;
    return report;
  }
  cost_.time("friction", [&] { apply_friction(now, dt, next, report); });
  if (!bears_explicit_viscosity(dt)) {
    bool converged = true;
    cost_.time("fluid viscosity", [&] { converged = apply_viscosity(now, dt, next); });
    if (!converged) {
      report.refused_because = "the fluid viscosity did not converge";
      return report;
    }
  }
  cost_.time("pressure", [&] {
    report.pressure = pressure_.solve(
        dt, now.f_s,
        {now.theta, rheology_.restitution, rheology_.part_cells.resting, now.packing,
         rheology_.viscous_stress.empty() ? nullptr : &rheology_.viscous_stress},
        inertia_, drag_.beta(), aperture_, now.u_s, next.u_s, next.u_c, next.p_c, next.p_s, flux_s_, flux_c_);
  });
  report.not_finite = !std::isfinite(report.friction.final) || !std::isfinite(report.pressure.mismatch) ||
                      !std::isfinite(report.pressure.divergence);
  report.refused_because = reason_to_refuse(now, dt, report);
  if (!report.refused_because.empty()) return report;

  cost_.time("transport", [&] {
    keep_solid_positive(grid_, boundary_, dt, now.f_s, flux_s_, flux_c_);
    flux_c_solved_ = flux_c_;
    if (whole_columns_)
      close_continuity(grid_, boundary_, aperture_, flux_s_, flux_c_);
    else
      continuity_tree_.close(boundary_, flux_s_, flux_c_);
    transport_solid(grid_, dt, now.f_s, flux_s_, next.f_s);
  });
  const double* f = next.f_s.data();
  const double densest =
      max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) { return f[c]; });
  if (!(densest <= largest_solid_fraction)) {
    report.refused_because = fmt::format("solid fraction {:.3f}", densest);
    report.not_finite = !std::isfinite(densest);
    return report;
  }
  const LiquidPassed* passed = nullptr;
  cost_.time("transport", [&] {
    if (scene_.model.colour) transport_with_grains(grid_, dt, now.f_s, next.f_s, flux_s_, now.phi, next.phi);
    if (scene_.model.carries_packing())
      transport_with_grains(grid_, dt, now.f_s, next.f_s, flux_s_, now.packing, next.packing);
    passed = &interface_.advance(dt, now.alpha, now.f_s, flux_c_, next.alpha);
    report.liquid_left = passed->total(grid_);
    report.solid_left = solid_left(grid_, dt, flux_s_);
    set_pressure_level(grid_, scene_, next.alpha, next.p_c);
    boundary_.fill_solid_fraction(next.f_s);
    boundary_.fill_velocity(next.u_s, Phase::solid);
  });
  double carried = 0.0;
  cost_.time("energy budget", [&] { carried = budget_.elastic(next.f_s, next.packing); });
  if (scene_.model.shear_dilatancy) {
    cost_.time("packing", [&] { dilate(dt, next); });
  }
  GranularLosses granular;
  Friction::Power stress;
  cost_.time("granular temperature", [&] {
    stress = friction_.power(mass_, next.u_strain, next.u_s, production_);
    strain_.update(grid_, next.u_s);
    granular = temperature_.advance(dt, now.theta, now.f_s, next.f_s, flux_s_, drag_.beta_of_cells(),
                                    rheology_, strain_, production_, next.theta);
  });
  next.fill_ghosts(boundary_);
  cost_.time("energy budget", [&] { account_energy(now, dt, stress, granular, carried, *passed, next); });
  report.accepted = true;
  return report;
}

// Kinetic viscosity of the step: at the old Theta, or where grains begin to shear at a share of what they
// get.
void TimeStep::stir_grains(const State& now, double dt) {
  if (scene_.model.granular_temperature == TemperatureModel::off) return;
  strain_.update(grid_, now.u_strain);
  temperature_.predict(dt, now.theta, now.f_s, drag_.beta_of_cells(), rheology_.restitution, strain_,
                       stirred_);
  rheology_.update_kinetic_viscosity(grid_, scene_, boundary_, now.f_s, stirred_);
}

// Explicit part of (5) and (6): convection, fluid viscosity, gravity. The old pressure gradient of the fluid
// is in its predictor; the solid's enters the implicit friction step, or the bed would hang on its own
// viscosity.
void TimeStep::predict(const State& now, double dt) {
  kinematic_viscosity_ = viscosity_.update(boundary_, now.u_c, now.f_s, now.alpha);
  const bool limited = scene_.numerics.solid_flux != SolidFlux::upwind;
  const double between_gas_and_liquid = std::sqrt(scene_.gas.density * scene_.liquid.density);
  upwind_ = viscous_power_ = 0.0;
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double gravity = gravity_of(scene_)[d], inv_h = 1.0 / grid_.h[d];
    const Range fluid = grid_.fluid_faces(d), solid = grid_.inner_faces(d);
    if (limited && !scene_.liquid_boxes.empty()) {
      upwind_ +=
          grid_.cell_volume * convective_acceleration_limited_in(inertia_.fluid[d], between_gas_and_liquid,
                                                                 grid_, now.u_c, d, fluid, convective_c_[d]);
    } else {
      upwind_ += grid_.cell_volume * convective_acceleration(inertia_.fluid[d], grid_, now.u_c, d, fluid,
                                                             limited, convective_c_[d]);
    }
    predicted_c_[d] = convective_c_[d];
    viscosity_.add_acceleration(now.u_c, inertia_, d, fluid, predicted_c_[d]);
    viscous_power_ += viscosity_.power_on(now.u_c, inertia_, d, convective_c_[d], predicted_c_[d]);
    upwind_ += grid_.cell_volume *
               convective_acceleration(inertia_.solid[d], grid_, now.u_s, d, solid, limited, predicted_s_[d]);
    bound_convection(grid_, now.u_s, d, solid, dt, inertia_.f_s[d], solid_that_counts, predicted_s_[d]);
    const double *open = aperture_[d].data(), *f = inertia_.f_s[d].data(), *m = inertia_.fluid[d].data();
    const double *uc = now.u_c[d].data(), *us = now.u_s[d].data(), *p = now.p_c.data();
    double *c_star = predicted_c_[d].data(), *s_star = predicted_s_[d].data();
    for_each(grid_.cells, fluid, [=](std::ptrdiff_t c) {
      const double pressure = (1.0 - f[c]) * (p[c] - p[c - s]) * inv_h / m[c];
      c_star[c] = open[c] * (uc[c] + dt * (c_star[c] + gravity - pressure));
    });
    for_each(grid_.cells, solid,
             [=](std::ptrdiff_t c) { s_star[c] = open[c] * (us[c] + dt * (s_star[c] + gravity)); });
    boundary_.exchange(predicted_c_[d]);
    boundary_.exchange(predicted_s_[d]);
  }
}

void TimeStep::add_to_predictor(const BodyAcceleration& extra, double dt) {
  for (int d = 0; d < grid_.dim; ++d) {
    const double *open = aperture_[d].data(), *fluid = extra.fluid[d].data(), *solid = extra.solid[d].data();
    double *c_star = predicted_c_[d].data(), *s_star = predicted_s_[d].data();
    for_each(grid_.cells, grid_.fluid_faces(d),
             [=](std::ptrdiff_t c) { c_star[c] += dt * open[c] * fluid[c]; });
    for_each(grid_.cells, grid_.inner_faces(d),
             [=](std::ptrdiff_t c) { s_star[c] += dt * open[c] * solid[c]; });
    boundary_.exchange(predicted_c_[d]);
    boundary_.exchange(predicted_s_[d]);
  }
}

// Implicit friction, kinetic viscosity and drag of u_s with the old pressure gradients; u_c is eliminated
// face by face: beta_eff = beta m_c / (m_c + beta), m_c = f_c rho_c / dt.
void TimeStep::apply_friction(const State& now, double dt, State& next, StepReport& report) {
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d], inv_dt = 1.0 / dt;
    const double *f = inertia_.f_s[d].data(), *solid = inertia_.solid[d].data(),
                 *fluid = inertia_.fluid[d].data();
    const double *beta = drag_.beta()[d].data(), *open = aperture_[d].data();
    const double *p_c = now.p_c.data(), *p_s = now.p_s.data(), *us = now.u_s[d].data();
    const double *c_star = predicted_c_[d].data(), *s_star = predicted_s_[d].data();
    double *mass = mass_[d].data(), *rhs = rhs_[d].data(), *guess = next.u_s[d].data();
    for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) {
      const double m_s = solid[c] * inv_dt, m_c = fluid[c] * inv_dt;
      const double beta_eff = beta[c] * m_c / (m_c + beta[c]);
      mass[c] = m_s + beta_eff;
      rhs[c] = m_s * s_star[c] + beta_eff * c_star[c] - f[c] * (p_c[c] - p_c[c - s]) * inv_h -
               (p_s[c] - p_s[c - s]) * inv_h;
      guess[c] = open[c] * (f[c] >= least_solid_fraction ? us[c] : c_star[c]);
    });
    boundary_.exchange(next.u_s[d]);
  }
  report.friction = friction_.solve(mass_, rhs_, inertia_, aperture_, rheology_, now.u_strain, next.u_s);
  for (int d = 0; d < grid_.dim; ++d) {
    const double inv_dt = 1.0 / dt;
    const double *fluid = inertia_.fluid[d].data(), *beta = drag_.beta()[d].data();
    const double *c_star = predicted_c_[d].data(), *us = next.u_s[d].data();
    double* uc = next.u_c[d].data();
    for_each(grid_.cells, grid_.fluid_faces(d), [=](std::ptrdiff_t c) {
      const double m_c = fluid[c] * inv_dt;
      uc[c] = (m_c * c_star[c] + beta[c] * us[c]) / (m_c + beta[c]);
    });
    boundary_.exchange(next.u_c[d]);
  }
  next.u_strain = next.u_s;
}

bool TimeStep::bears_explicit_viscosity(double dt) const {
  double inverse_squares = 0.0;
  for (int d = 0; d < grid_.dim; ++d)
    if (grid_.cells.n[d] > 1) inverse_squares += 1.0 / (grid_.h[d] * grid_.h[d]);
  return kinematic_viscosity_ * dt * inverse_squares <= explicit_viscous_number;
}

// Few scenes need it, and it takes an eighth of a run's memory.
bool TimeStep::apply_viscosity(const State& now, double dt, State& next) {
  if (!implicit_viscosity_) implicit_viscosity_.emplace(grid_, scene_, boundary_);
  return implicit_viscosity_->apply(dt, viscosity_.of_cells(), inertia_, drag_.beta(), aperture_, now.u_c,
                                    predicted_c_, next.u_c, next.u_s);
}

// Packing of the bed after the shear that friction worked on: elastic waves of the pressure step, which it
// has not felt yet, would dilate the bed with energy from nothing.
void TimeStep::dilate(double dt, State& next) {
  boundary_.fill_velocity(next.u_strain, Phase::solid);
  strain_.update(grid_, next.u_strain);
  shear_packing(grid_, scene_, dt, next.f_s, rheology_, strain_, next.packing);
}

void TimeStep::account_energy(const State& now, double dt, const Friction::Power& stress,
                              const GranularLosses& granular, double carried, const LiquidPassed& passed,
                              State& next) {
  const bool implicit = !bears_explicit_viscosity(dt);
  if (implicit) viscosity_.set_strain(next.u_c);
  const FluidViscosity::Power viscous = viscosity_.power(boundary_, implicit ? next.u_c : now.u_c);
  if (implicit) viscous_power_ = viscous.walls + viscous.sides - viscous.dissipation;
  next.energy.add(budget_.of_step(
      dt, now, next,
      {inertia_, drag_.beta(), predicted_s_, predicted_c_, convective_c_, flux_s_, flux_c_, flux_c_solved_,
       rheology_, strain_, upwind_, viscous_power_, viscous, stress, granular, carried, passed}));
}

std::string TimeStep::reason_to_refuse(const State& now, double dt, const StepReport& report) const {
  if (!std::isfinite(report.friction.final)) return "the friction solve is not finite";
  if (!std::isfinite(report.pressure.mismatch) || !std::isfinite(report.pressure.divergence))
    return "the pressure solve is not finite";
  if (!report.pressure.converged)
    return fmt::format(
        "the coupled pressures did not converge in {} iterations (solid fraction off by {:.1e})",
        report.pressure.newton, report.pressure.mismatch);
  const double solid = outflow_courant(grid_, dt, now.f_s, false, solid_that_counts, flux_s_);
  if (!(solid <= largest_outflow)) return fmt::format("outflow Courant number {:.2f} of the solid", solid);
  const double fluid = outflow_courant(grid_, dt, now.f_s, true, 0.0, flux_c_);
  if (!(fluid <= largest_outflow)) return fmt::format("outflow Courant number {:.2f} of the fluid", fluid);
  return {};
}

}  // namespace granvof
