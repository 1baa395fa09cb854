#include "solver/run/alarms.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double largest_volume_error = 1e-9;  // of the solid and of the liquid; rounding gives 1e-14
constexpr double lowest_fraction = -1e-9;
constexpr double largest_energy_residual = 0.01;  // of the energy turned over
// Of what physics dissipated and what is in motion. First-order volume transport lifts what it spreads. Where
// half of what is dissipated was never there the flow is numerics.
constexpr double largest_energy_created = 0.5;
constexpr double largest_share_of_bounds = 0.01;  // the same, taken by the bounds on Theta
// Contacts that store more than the bed's own height does: such a bed is not at rest but springs apart, by an
// amount that the stiffness and the first few steps decide.
constexpr double largest_elastic_start = 1.0;  // of the bed's potential energy above its base
// P_s beside an outlet, of the scene's own: grains of a flow bring next to none, a bed that leans on it a
// third.
constexpr double largest_outlet_load = 0.1;
constexpr double unconverged_share = 0.01;  // of the friction solves
// Of all steps that were tried; runs of the shipped cases have at most 0.01. A few in a short run are none.
constexpr double refused_share = 0.05;
constexpr double few_refused = 20.0;
constexpr double energy_that_stops = 10.0;  // in motion, of all that the run was given
// Below these shares nothing counts as turned over.
constexpr double least_share_of_store = 1e-6;
constexpr double least_share_of_bed = 1e-2;

// What a flow that dissipates next to nothing may create: a share of the bed's own energy, or of the scene's
// where no bed has any, as none has without gravity. Not of what the tank's water stores, which a bed at rest
// does not turn over.
double least_own_energy(const Scene& scene) {
  const double of_bed = energy_of_bed(scene);
  return least_share_of_bed * (of_bed > 0.0 ? of_bed : scales_of(scene).energy);
}

// Viscous forces that a step takes at one velocity and that work on another misplace what viscosity
// dissipates: up to all of that nothing is created by it.
double created_beside_misplaced(const EnergyTerms& e) {
  return e.created() - std::clamp(-e.numerical_viscosity, 0.0, std::max(e.viscosity, 0.0));
}

// Without gravity a tank at rest stores nothing to take shares of: then of the scene's own energy.
double least_energy(const Scene& scene, const EnergyTerms& start) {
  return least_share_of_store * (std::fabs(start.stored()) + scales_of(scene).energy) +
         least_share_of_bed * energy_of_bed(scene);
}

}  // namespace

Alarms::Alarms(const Scene& scene, const EnergyTerms& start) : scene_(scene), start_(start) {}

double energy_turnover(const Scene& scene, const EnergyTerms& start, const EnergyTerms& now) {
  return now.physical() + now.numerical_magnitude() + now.in_motion() + now.carried_out() +
         least_energy(scene, start);
}

double energy_created(const Scene& scene, const EnergyTerms& now) {
  return created_beside_misplaced(now) /
         (now.physical() + now.in_motion() + now.carried_out() + least_own_energy(scene));
}

void Alarms::watch(const char* monitor, double value, double limit, double time, const char* meaning) {
  if (value <= limit) return;
  const auto found =
      std::find_if(raised_.begin(), raised_.end(), [&](const Warning& w) { return w.monitor == monitor; });
  if (found != raised_.end()) {
    found->value = std::max(found->value, value);
    return;
  }
  raised_.push_back({monitor, time, value, limit, meaning});
  spdlog::warn("{}: t = {:.6g} s: {} {:.3g}, limit {:g}: {}", scene_.name, time, monitor, value, limit,
               meaning);
}

std::string Alarms::check(const State& s, const Monitors& monitors, const StepCounts& counts) {
  const auto look = [&](const char* monitor, double value, double limit, const char* meaning) {
    watch(monitor, value, limit, s.time, meaning);
  };
  const EnergyTerms& e = s.energy;
  const double turnover = energy_turnover(scene_, start_, e);
  look("solid volume", monitors.solid_volume_error(), largest_volume_error, "grains are lost or made");
  look("liquid volume", monitors.liquid_volume_error(), largest_volume_error, "liquid is lost or made");
  look("solid fraction", monitors.solid_fraction_max(), scene_.contact.solid_fraction_max,
       "denser than contact.solid_fraction_max");
  look("negative fraction", -monitors.solid_fraction_min(), -lowest_fraction,
       "a cell holds less than nothing");
  look("energy residual", std::fabs(e.residual) / turnover, largest_energy_residual,
       "momentum or continuity is not solved well enough, or an operator misstates its work: the energy "
       "budget does not close");
  look("energy created", energy_created(scene_, e), largest_energy_created,
       "numerics or the uncharged work of P_s^EF give the flow energy from nothing");
  look("elastic start", start_.elastic / std::max(energy_of_bed(scene_), least_energy(scene_, start_)),
       largest_elastic_start,
       "the bed starts so dense that its contacts hold more energy than its height: it springs apart, and "
       "how far depends on contact.stiffness and on the first steps");
  look("outlet load", monitors.outlet_load(s) / scales_of(scene_).pressure, largest_outlet_load,
       "grains lean on an outlet, which holds them: they leave at the speed at which they arrive, not by "
       "their "
       "own weight");
  look("granular bounds", e.theta_bounds / turnover, largest_share_of_bounds,
       "Theta runs into its stated bounds");
  look("friction solves", static_cast<double>(counts.unconverged_friction),
       std::max(1.0, unconverged_share * static_cast<double>(counts.steps)),
       "friction solves did not converge");
  look("refused steps", static_cast<double>(counts.refused),
       std::max(few_refused, refused_share * static_cast<double>(counts.steps + counts.refused)),
       "steps are tried in vain: numerics.newton_max, cfl or dt_max do not suit the flow");
  // In an inclined tank the potential counts from the upper end and may be negative: its size is what counts.
  const double given =
      std::fabs(start_.stored()) + e.walls + std::max(-e.outflow, 0.0) + least_energy(scene_, start_);
  if (e.in_motion() > energy_that_stops * given)
    return fmt::format("blow-up: {:.3g} J in motion at t = {:.6g} s, and the run was given {:.3g} J",
                       e.in_motion(), s.time, given);
  return {};
}

}  // namespace granvof
