#include "solver/run/time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/operators/continuity_closure.hpp"
#include "solver/operators/packing.hpp"
#include "solver/operators/solid_transport.hpp"
#include "solver/run/step_control.hpp"

namespace granvof {
namespace {

constexpr double largest_outflow = 0.95;  // share of a cell's content that may leave it in one step
// Beyond the larger of them the step's packing is not to be trusted; of f_s,max a twentieth.
constexpr double largest_solid_fraction = 0.66, largest_of_solid_fraction_max = 1.05;

}  // namespace

std::span<const TimeStep::Stage> TimeStep::stages() {
  using namespace parts;
  static constexpr std::array list{
      Stage{"closures",
            {&drag, &fluid_viscosity, &solid_pressure, &kinetic_stress, &friction},
            "laws of the old level: inertia of faces, restitution, solid pressure, drag, fluid viscosity, "
            "kinetic viscosity at a predicted Theta",
            &TimeStep::close},
      Stage{"predictor",
            {&momentum, &fluid_viscosity},
            "explicit: convection, gravity, fluid viscosity, the fluid's old pressure gradient",
            &TimeStep::predict},
      Stage{"friction",
            {&momentum, &kinetic_stress, &friction, &drag, &bed_surface},
            "implicit: solid stress and drag, the fluid eliminated",
            &TimeStep::shear_solid},
      Stage{"packing",
            {&packing},
            "by the shear of the step, with shear dilatancy: the pressure stage meets what it left",
            &TimeStep::pack,
            &TimeStep::packing_follows_shear},
      Stage{"fluid viscosity",
            {&momentum, &fluid_viscosity},
            "implicit, where the step is too long for the explicit term",
            &TimeStep::diffuse_fluid,
            &TimeStep::outruns_explicit_viscosity},
      Stage{"pressure",
            {&pressure, &momentum, &drag, &solid_pressure, &viscous_contacts},
            "Newton on both pressures, drag within",
            &TimeStep::press},
      Stage{"transport",
            {&pressure},
            "fluxes that empty no cell; what is left of continuity is taken off the fluid's",
            &TimeStep::balance_fluxes},
      Stage{"transport",
            {&grains_transport, &packing},
            "grains, their colour and packing",
            &TimeStep::carry_solid,
            &TimeStep::holds_grains},
      Stage{"transport", {&interface}, "liquid and gas", &TimeStep::carry_liquid},
      Stage{"granular temperature",
            {&granular_temperature, &kinetic_stress},
            "fed by what the kinetic stress spent",
            &TimeStep::agitate,
            &TimeStep::holds_grains},
      Stage{"energy budget", {&ledger}, "what every stage did to the energy", &TimeStep::account},
  };
  return list;
}

StepReport TimeStep::advance(const State& now, double dt, State& next, const BodyAcceleration* extra) {
  next = now;
  next.time = now.time + dt;
  Attempt step{now, dt, next, extra};
  for (const Stage& stage : stages()) {
    if (stage.due != nullptr && !(this->*stage.due)(step)) continue;
    cost_.time(stage.cost, [&] { (this->*stage.run)(step); });
    if (!step.report.refused_because.empty()) return step.report;
  }
  step.report.accepted = true;
  return step.report;
}

TimeStep::TimeStep(const Grid& grid, const Scene& scene, Boundary& boundary)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      law_(scene),
      aperture_(grid, scene),
      inertia_(grid),
      drag_(grid, scene),
      rheology_(grid),
      viscosity_(grid, scene),
      predictor_(grid, scene, boundary),
      solid_momentum_(grid, scene, boundary),
      pressure_(grid, scene, boundary, law_),
      interface_(grid, scene, boundary),
      temperature_(grid, scene, boundary, law_.collisions),
      strain_(grid),
      whole_columns_(grid.has_whole_columns()),
      continuity_tree_(grid),
      pressure_level_(grid, scene),
      budget_(grid, scene, boundary),
      flux_s_(grid),
      flux_c_(grid),
      flux_c_solved_(grid),
      stirred_(grid),
      production_(grid) {
  part_the_fluid();
  if (aperture_.has_gate()) boundary_.shut_gate(aperture_.gate_face(), aperture_.open_rows());
}

void TimeStep::move_gate(double time) {
  if (!aperture_.update(time)) return;
  part_the_fluid();
  boundary_.shut_gate(aperture_.gate_face(), aperture_.open_rows());
}

// As obstacles and the gate do where it stands.
void TimeStep::part_the_fluid() {
  const bool may_be_parted = pressure_level_.may_be_parted();
  if (!whole_columns_ || may_be_parted) continuity_tree_.grow(aperture_);
  if (may_be_parted) pressure_level_.find_parts(continuity_tree_);
}

// What the old level says of the laws. The kinetic viscosity is taken at the old Theta, or where grains begin
// to shear at a share of what they get.
void TimeStep::close(Attempt& step) {
  const State& now = step.now;
  move_gate(step.next.time);
  inertia_.update(grid_, scene_, now.f_s, now.alpha);
  viscosity_.update(boundary_, now);
  if (!inertia_.holds_grains) return drag_.clear();
  const bool agitated = closures::agitates(scene_.model.granular_temperature);
  if (agitated || scene_.model.viscous_contact_pressure)
    strain_.update(grid_, boundary_.walls(), now.u_strain);
  rheology_.update(grid_, scene_, law_, boundary_, now, strain_);
  drag_.update(boundary_, now, inertia_, rheology_);
  if (!agitated) return;
  temperature_.predict(step.dt, now, drag_.beta_of_cells(), rheology_.restitution, strain_, stirred_);
  rheology_.update_kinetic_viscosity(grid_, scene_, law_, boundary_, now.f_s, stirred_);
}

void TimeStep::predict(Attempt& step) {
  predictor_.update(step.dt, step.now, inertia_, viscosity_, aperture_, step.extra);
  step.viscous_power = predictor_.viscous_power();
  if (std::isfinite(viscosity_.largest_kinematic())) return;
  step.report.refused_because = "the viscosity of the fluid is not finite";
  step.report.not_finite = true;
}

void TimeStep::shear_solid(Attempt& step) {
  linear::Report& report = step.report.friction;
  report =
      solid_momentum_.solve(step.dt, step.now, predictor_, inertia_, drag_, rheology_, aperture_, step.next);
  if (std::isfinite(report.final)) return;
  step.report.refused_because = "the friction solve is not finite";
  step.report.not_finite = true;
}

// After the shear that friction worked on: elastic waves of the pressure stage, which it has not felt yet,
// would dilate the bed with energy from nothing. Before that stage: a bed that shear loosens or packs by more
// in a step than (13) takes to bear its load would else be held, or let go, a step too late.
void TimeStep::pack(Attempt& step) {
  State& next = step.next;
  boundary_.fill_velocity(next.u_strain, Phase::solid);
  strain_.update(grid_, boundary_.walls(), next.u_strain);
  shear_packing(grid_, scene_, step.dt, step.now.f_s, rheology_, strain_, next.packing);
  boundary_.fill_scalar(next.packing);
  sheared_packing_ = next.packing;
}

void TimeStep::diffuse_fluid(Attempt& step) {
  if (!implicit_viscosity_) implicit_viscosity_.emplace(grid_, scene_, boundary_);
  if (!implicit_viscosity_->apply(step.dt, viscosity_.of_cells(), inertia_, drag_.beta(), aperture_,
                                  step.now.u_c, predictor_.fluid(), step.next.u_c, step.next.u_s))
    step.report.refused_because = "the fluid viscosity did not converge";
}

void TimeStep::press(Attempt& step) {
  PressureReport& report = step.report.pressure;
  report = pressure_.solve(step.dt, step.now, rheology_, inertia_, drag_.beta(), aperture_, step.next,
                           flux_s_, flux_c_);
  step.report.not_finite = !std::isfinite(report.mismatch) || !std::isfinite(report.divergence);
  if (step.report.not_finite)
    step.report.refused_because = "the pressure solve is not finite";
  else if (!report.converged)
    step.report.refused_because =
        fmt::format("the coupled pressures did not converge in {} iterations (solid fraction off by {:.1e})",
                    report.newton, report.mismatch);
}

// Fluxes that both balances of volume can be advanced by: none empties a cell, and both together are free of
// divergence to rounding.
void TimeStep::balance_fluxes(Attempt& step) {
  const Field& f_s = step.now.f_s;
  const bool grains = inertia_.holds_grains;
  const double least = solid_that_counts_in(scene_),
               solid = grains ? outflow_courant(grid_, step.dt, f_s, false, least, flux_s_) : 0.0,
               fluid = outflow_courant(grid_, step.dt, f_s, true, 0.0, flux_c_);
  if (!(solid <= largest_outflow) || !(fluid <= largest_outflow)) {
    const bool of_solid = !(solid <= largest_outflow);
    step.report.refused_because = fmt::format("outflow Courant number {:.2f} of the {}",
                                              of_solid ? solid : fluid, of_solid ? "solid" : "fluid");
    return;
  }
  if (grains) keep_solid_positive(grid_, boundary_, step.dt, f_s, flux_s_, flux_c_);
  flux_c_solved_ = flux_c_;
  if (whole_columns_)
    close_continuity(grid_, boundary_, aperture_, flux_s_, flux_c_);
  else
    continuity_tree_.close(boundary_, flux_s_, flux_c_);
}

void TimeStep::carry_solid(Attempt& step) {
  const State& now = step.now;
  State& next = step.next;
  transport_solid(grid_, step.dt, now.f_s, flux_s_, next.f_s);
  const double* f = next.f_s.data();
  const double densest =
      max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) { return f[c]; });
  if (!(densest <= std::max(largest_solid_fraction,
                            largest_of_solid_fraction_max * scene_.contact.solid_fraction_max))) {
    step.report.refused_because = fmt::format("solid fraction {:.3f}", densest);
    step.report.not_finite = !std::isfinite(densest);
    return;
  }
  const auto with_grains = [&](const Field& from, Field& to) {
    transport_with_grains(grid_, step.dt, now.f_s, next.f_s, flux_s_, from, to);
  };
  if (scene_.model.colour) with_grains(now.phi, next.phi);
  if (scene_.model.carries_packing()) with_grains(packing_of(step), next.packing);
  step.report.solid_left = solid_left(grid_, step.dt, flux_s_);
  boundary_.fill_solid_fraction(next.f_s);
  boundary_.fill_velocity(next.u_s, Phase::solid);
  step.elastic = budget_.elastic(next.f_s, next.packing);
}

void TimeStep::carry_liquid(Attempt& step) {
  step.passed = &interface_.advance(step.dt, step.now, flux_c_, step.next);
  step.report.liquid_left = step.passed->total(grid_);
  pressure_level_.set(step.next.alpha, step.next.p_c);
}

void TimeStep::agitate(Attempt& step) {
  step.stress = solid_momentum_.power(step.next, production_);
  strain_.update(grid_, boundary_.walls(), step.next.u_s);
  step.granular = temperature_.advance(step.dt, step.now, flux_s_, drag_.beta_of_cells(), rheology_, strain_,
                                       production_, step.next);
}

void TimeStep::account(Attempt& step) {
  State& next = step.next;
  next.fill_ghosts(boundary_);
  const bool implicit = outruns_explicit_viscosity(step);
  if (implicit) viscosity_.set_strain(boundary_, next.u_c);
  const FluidViscosity::Power viscous = viscosity_.power(boundary_, implicit ? next.u_c : step.now.u_c);
  if (implicit) step.viscous_power = viscous.walls + viscous.sides - viscous.dissipation;
  next.energy.add(budget_.of_step(step.dt, step.now, next,
                                  {law_, inertia_, drag_.beta(), predictor_, flux_s_, flux_c_, flux_c_solved_,
                                   rheology_, strain_, step.viscous_power, viscous, step.stress,
                                   step.granular, packing_of(step), step.elastic, *step.passed}));
}

}  // namespace granvof
