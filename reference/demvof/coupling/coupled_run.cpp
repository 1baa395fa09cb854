#include "reference/demvof/coupling/coupled_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/closures/drag/drag.hpp"

namespace demvof {

namespace {

constexpr double courant_limit = 0.5;        // of the liquid, per fluid step: MULES is explicit
constexpr double least_void_fraction = 0.2;  // below it beads overlap: the run is lost

std::vector<double> void_fraction(const std::vector<double>& solid_fraction) {
  std::vector<double> eps(solid_fraction.size());
  std::transform(solid_fraction.begin(), solid_fraction.end(), eps.begin(), [](double f) { return 1.0 - f; });
  if (*std::min_element(eps.begin(), eps.end()) < least_void_fraction) {
    throw std::runtime_error("the beads overlap: a cell holds more than 80 % solid");
  }
  return eps;
}

}  // namespace

CoupledRun::CoupledRun(const CouplingSettings& settings, const BeadSettings& beads, const BeadState& mobile,
                       const std::vector<double>& frozen_positions, const FluidSettings& fluid,
                       const std::vector<double>& alpha)
    : settings_(settings), fluid_settings_(fluid), mapping_(fluid.cells, fluid.spacing, fluid.obstacles) {
  beads_ = std::make_unique<BeadEngine>(beads, mobile, frozen_positions);
  if (settings_.closed_gate) {
    mapping_.set_gate(*settings_.closed_gate,
                      std::vector<double>(static_cast<std::size_t>(fluid.cells[1]), 1.0));
  }
  mapping_.update(beads_->state().position);
  deposit_solid_fraction();
  fluid_ = std::make_unique<Fluid>(fluid, alpha, void_fraction(solid_fraction_));
  load_.resize(mobile.count());
  carry_.assign(3 * mobile.count(), 0.0);
  last_duration_ = settings_.fluid_dt;
  if (settings_.predict_pressure) {
    predicted_.assign(3 * mobile.count(), 0.0);
    for (int d = 0; d < 3; ++d) {
      mapping_.gather(fluid_->view().pressure_gradient[static_cast<std::size_t>(d)], 3, d, predicted_);
    }
    for (double& f : predicted_) f *= -beads_->bead_volume();
  }
  reaction_.drag_coefficient.assign(mapping_.cell_count(), 0.0);
  for (auto& component : reaction_.force) component.assign(mapping_.cell_count(), 0.0);
  renew_load();
}

void CoupledRun::deposit_solid_fraction() {
  solid_fraction_.assign(mapping_.cell_count(), 0.0);
  mapping_.deposit(beads_->bead_volume() / mapping_.cell_volume(), solid_fraction_);
}

// In a step in which the liquid moves by less than half a cell.
long CoupledRun::bead_steps_allowed() const {
  double duration = settings_.fluid_dt;
  const double rate = std::max(fluid_->courant_rate_liquid(), 0.25 * fluid_->courant_rate());
  if (rate * duration > courant_limit) duration = courant_limit / rate;
  return std::max(1L, static_cast<long>(std::floor(duration / beads_->settings().dt * (1.0 + 1e-9))));
}

std::vector<double> CoupledRun::displacement(const std::vector<double>& old_position) const {
  const bool wrap = beads_->settings().periodic_depth;
  const double depth = beads_->settings().tank[2];
  std::vector<double> moved = beads_->state().position;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    moved[n] -= old_position[n];
    if (n % 3 == 2 && wrap) moved[n] -= depth * std::round(moved[n] / depth);
  }
  return moved;
}

std::vector<double> CoupledRun::drag_impulse(const std::vector<double>& moved, double duration) const {
  std::vector<double> impulse(moved.size());
  for (std::size_t n = 0; n < moved.size(); ++n)
    impulse[n] = load_.coefficient[n / 3] * (load_.velocity[n] * duration - moved[n]);
  return impulse;
}

double CoupledRun::step() {
  return advance(static_cast<int>(bead_steps_allowed()));
}

double CoupledRun::step(double left_to_go) {
  // Equal shares of what is left: a short last step would break the lag of one step between the two sides.
  const auto left = std::max(1L, std::lround(left_to_go / beads_->settings().dt));
  const long most = bead_steps_allowed(), shares = (left + most - 1) / most;
  return advance(static_cast<int>((left + shares - 1) / shares));
}

double CoupledRun::advance(int bead_steps) {
  const double duration = bead_steps * beads_->settings().dt;

  FluidLoad with_carry = load_;
  for (std::size_t n = 0; n < carry_.size(); ++n) with_carry.force[n] += carry_[n] / duration;
  const std::vector<double> old_position = beads_->state().position;
  beads_->set_load(with_carry);
  beads_->run(bead_steps);

  mean_slip_work_ += mean_slip_power_ * duration;
  const std::vector<double> moved = displacement(old_position);
  for (std::size_t n = 0; n < moved.size(); ++n) pressure_work_ += load_.force[n] * moved[n];
  const std::vector<double> impulse = drag_impulse(moved, duration);
  mapping_.update(beads_->state().position);
  deposit_solid_fraction();
  reaction_.void_fraction = void_fraction(solid_fraction_);
  const double volume = mapping_.cell_volume();
  std::fill(reaction_.drag_coefficient.begin(), reaction_.drag_coefficient.end(), 0.0);
  mapping_.deposit(load_.coefficient, 1, 0, reaction_.drag_coefficient);
  for (double& k : reaction_.drag_coefficient) k /= volume;
  for (int d = 0; d < 3; ++d) {
    std::vector<double>& force = reaction_.force[static_cast<std::size_t>(d)];
    std::fill(force.begin(), force.end(), 0.0);
    mapping_.deposit(impulse, 3, d, force);
    for (double& f : force) f *= -1.0 / (volume * duration);
  }

  const auto old_velocity = fluid_->view().velocity;
  fluid_->step(duration, reaction_);
  time_ += duration;
  last_duration_ = duration;

  for (int d = 0; d < 3; ++d) {
    std::vector<double> change = fluid_->view().velocity[static_cast<std::size_t>(d)];
    const std::vector<double>& old = old_velocity[static_cast<std::size_t>(d)];
    for (std::size_t c = 0; c < change.size(); ++c) change[c] -= old[c];
    mapping_.gather(change, 3, d, carry_);
  }
  for (std::size_t n = 0; n < carry_.size(); ++n) carry_[n] *= load_.coefficient[n / 3] * duration;
  renew_load();
  return duration;
}

void CoupledRun::renew_load() {
  const FluidView& view = fluid_->view();
  const double volume = beads_->bead_volume();
  for (int d = 0; d < 3; ++d) {
    const auto component = static_cast<std::size_t>(d);
    mapping_.gather(view.velocity[component], 3, d, load_.velocity);
    mapping_.gather(view.pressure_gradient[component], 3, d, load_.force);
  }
  for (double& f : load_.force) f *= -volume;
  if (settings_.drag) renew_drag();
  mean_slip_power_ = mean_slip_power();
  if (settings_.predict_pressure) predict_pressure_force();
}

// Of the drag on beads that all move as their surroundings do, cell by cell of the mapping.
double CoupledRun::mean_slip_power() const {
  const std::size_t cells = mapping_.cell_count();
  std::vector<double> number(cells, 0.0), mean(load_.coefficient.size());
  mapping_.deposit(1.0, number);
  double power = 0.0;
  for (int d = 0; d < 3; ++d) {
    std::vector<double> velocity(cells, 0.0);
    mapping_.deposit(beads_->state().velocity, 3, d, velocity);
    for (std::size_t c = 0; c < cells; ++c)
      if (number[c] > 0.0) velocity[c] /= number[c];
    mapping_.gather(velocity, 1, 0, mean);
    for (std::size_t b = 0; b < mean.size(); ++b) {
      const double slip = load_.velocity[3 * b + static_cast<std::size_t>(d)] - mean[b];
      power += load_.coefficient[b] * slip * slip;
    }
  }
  return power;
}

void CoupledRun::renew_drag() {
  const FluidView& view = fluid_->view();
  const granvof::Fluid gas{fluid_settings_.gas_density, fluid_settings_.gas_viscosity};
  const granvof::Fluid liquid{fluid_settings_.liquid_density, fluid_settings_.liquid_viscosity};

  std::vector<double> alpha(load_.coefficient.size()), f_s(load_.coefficient.size());
  mapping_.gather(view.alpha, 1, 0, alpha);
  mapping_.gather(solid_fraction_, 1, 0, f_s);
  const std::vector<double>& velocity = beads_->state().velocity;
  // Of the grains: drag and slip Reynolds number are theirs, so that the drag per volume is that of the bed.
  const double k = settings_.coarse_graining, grains = k * k * k;
  const double diameter = beads_->settings().diameter / k;
  settings_.drag_law.with([&](auto law) {
    for (std::size_t bead = 0; bead < load_.coefficient.size(); ++bead) {
      const double slip = std::hypot(load_.velocity[3 * bead] - velocity[3 * bead],
                                     load_.velocity[3 * bead + 1] - velocity[3 * bead + 1],
                                     load_.velocity[3 * bead + 2] - velocity[3 * bead + 2]);
      load_.coefficient[bead] =
          grains * granvof::closures::drag_on_grain(law, f_s[bead], std::clamp(alpha[bead], 0.0, 1.0), slip,
                                                    gas, liquid, diameter);
    }
  });
}

void CoupledRun::predict_pressure_force() {
  const std::size_t cells = mapping_.cell_count();
  const double volume = beads_->bead_volume(), cell_volume = mapping_.cell_volume();
  // What the last prediction missed of the pressure that the fluid then had.
  std::vector<double> missed(load_.force.size());
  for (std::size_t n = 0; n < missed.size(); ++n) missed[n] = load_.force[n] - predicted_[n];

  BeadInertia inertia;
  inertia.density = beads_->settings().density;
  inertia.drag_coefficient.assign(cells, 0.0);
  mapping_.deposit(load_.coefficient, 1, 0, inertia.drag_coefficient);
  for (double& k : inertia.drag_coefficient) k /= cell_volume;
  for (int d = 0; d < 3; ++d) {
    const auto component = static_cast<std::size_t>(d);
    inertia.velocity[component].assign(cells, 0.0);
    inertia.force[component].assign(cells, 0.0);
    mapping_.deposit(beads_->state().velocity, 3, d, inertia.velocity[component]);
    mapping_.deposit(missed, 3, d, inertia.force[component]);
    for (std::size_t c = 0; c < cells; ++c) {
      inertia.force[component][c] /= cell_volume;
      double& u = inertia.velocity[component][c];
      u = solid_fraction_[c] > 1e-6 ? u * volume / (cell_volume * solid_fraction_[c])
                                    : fluid_->view().velocity[component][c];
    }
  }
  const auto gradient = fluid_->predict_pressure_gradient(last_duration_, inertia);
  for (int d = 0; d < 3; ++d) mapping_.gather(gradient[static_cast<std::size_t>(d)], 3, d, predicted_);
  for (std::size_t n = 0; n < missed.size(); ++n) {
    predicted_[n] *= -volume;
    load_.force[n] = predicted_[n] + missed[n];
  }
}

void CoupledRun::set_gate_edge(int face, double edge) {
  const auto rows = static_cast<std::size_t>(fluid_settings_.cells[1]);
  std::vector<double> open(rows);
  std::vector<double> closed(rows);
  for (std::size_t j = 0; j < rows; ++j) {
    open[j] = std::clamp(edge / fluid_settings_.spacing[1] - static_cast<double>(j), 0.0, 1.0);
    closed[j] = 1.0 - open[j];
  }
  fluid_->set_gate(face, open);
  mapping_.set_gate(face, closed);
}

void CoupledRun::remove_gate() {
  fluid_->set_gate(0, {});
  mapping_.set_gate(-1, {});
}

Vector CoupledRun::momentum() const {
  Vector total = fluid_->momentum();
  const std::vector<double>& velocity = beads_->state().velocity;
  const double mass = beads_->bead_mass();
  for (std::size_t n = 0; n < velocity.size(); ++n) {
    // With a prediction only what it missed is still owed; without, the whole pressure of the last fluid
    // step.
    const double owed = settings_.predict_pressure ? load_.force[n] - predicted_[n] : load_.force[n];
    total[n % 3] += mass * velocity[n] + carry_[n] + owed * last_duration_;
  }
  return total;
}

}  // namespace demvof
