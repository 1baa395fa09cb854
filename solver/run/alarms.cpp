#include "solver/run/alarms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "solver/scene/gravity.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double largest_volume_error = 1e-9;  // of the solid and of the liquid; rounding gives 1e-14
constexpr double lowest_fraction = -1e-9;
constexpr double largest_energy_residual = 0.01;  // of the energy turned over
// At rest next to none is, and what a pressure solve leaves of continuity still works against all that the
// tank stores: that counts by this share of it.
constexpr double least_share_of_store_at_rest = 1e-3;
// Of what the flow was given. First-order volume transport lifts what it spreads: columns of few cells get
// 0.7 so.
constexpr double largest_energy_created = 0.8;
// Of what became of it. Where schemes take more than all that physics does the flow is numerics. S1 and
// S2 get to 0.27, a bed that floats up against drag to 0.4.
constexpr double largest_energy_destroyed = 0.5;
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

// Where the flow's energy is now, or by what it left.
double became_of(const EnergyTerms& e) {
  return e.physical() + e.in_motion() + e.carried_out() + e.destroyed();
}

double share_of_what_became(const Scene& scene, const EnergyTerms& e, double part) {
  return part / (became_of(e) + least_own_energy(scene));
}

std::string most_destroyed(const Watched& w) {
  const EnergyTerms& e = w.state.energy;
  const EnergyTerm& most = *std::ranges::max_element(energy_terms, {}, [&](const EnergyTerm& term) {
    return term.kind == EnergyKind::numerical ? e.*term.value : 0.0;
  });
  return fmt::format(", {} most: {:.3g}", most.name, share_of_what_became(w.scene, e, e.*most.value));
}

// Without gravity a tank at rest stores nothing to take shares of: then of the scene's own energy.
double energy_at_hand(const Scene& scene, const EnergyTerms& start) {
  return std::fabs(start.stored()) + scales_of(scene).energy;
}

double least_energy(const Scene& scene, const EnergyTerms& start) {
  return least_share_of_store * energy_at_hand(scene, start) + least_share_of_bed * energy_of_bed(scene);
}

// What all that the tank holds gains where it runs from one end of an inclined floor to the other: the
// start's potential counts from one corner, and says nothing of how far down the other is [J].
double energy_of_slide(const Scene& scene, const Monitors& monitors, const State& s) {
  const double weight_along = std::fabs(confined_gravity(scene)[0]);
  if (weight_along == 0.0) return 0.0;
  const double mass =
      scene.solid.density * monitors.solid_volume(s) + scene.liquid.density * monitors.liquid_volume(s);
  return mass * weight_along * scene.tank[0];
}

double share_of_residual(const Watched& w) {
  return std::fabs(w.state.energy.residual) /
         (w.turnover + least_share_of_store_at_rest * energy_at_hand(w.scene, w.start));
}

}  // namespace

Alarms::Alarms(const Scene& scene, const EnergyTerms& start) : scene_(scene), start_(start) {}

double energy_turnover(const Scene& scene, const EnergyTerms& start, const EnergyTerms& now) {
  return now.physical() + now.numerical_magnitude() + now.in_motion() + now.carried_out() +
         least_energy(scene, start);
}

double energy_created(const Scene& scene, const EnergyTerms& now) {
  // Less than nothing where a flow lifted more than it turned over.
  const double given = std::max(became_of(now) - now.created(), 0.0);
  return created_beside_misplaced(now) / (given + least_own_energy(scene));
}

double energy_destroyed(const Scene& scene, const EnergyTerms& now) {
  return share_of_what_became(scene, now, now.destroyed());
}

void Alarms::watch(const Alarm& alarm, const Watched& watched) {
  const double value = alarm.value(watched), limit = alarm.limit(watched), time = watched.state.time;
  if (value <= limit) return;
  const auto found = std::ranges::find(raised_, alarm.monitor, &Warning::monitor);
  if (found != raised_.end()) {
    found->value = std::max(found->value, value);
    return;
  }
  std::string meaning = alarm.meaning;
  if (alarm.detail) meaning += alarm.detail(watched);
  raised_.push_back({alarm.monitor, time, value, limit, meaning});
  spdlog::warn("{}: t = {:.6g} s: {} {:.3g}, limit {:g}: {}", scene_.name, time, alarm.monitor, value, limit,
               meaning);
}

std::span<const Alarm> Alarms::list() {
  static constexpr std::array all{
      Alarm{"solid volume", parts::grains_transport, "grains are lost or made",
            [](const Watched& w) { return w.monitors.solid_volume_error(); },
            [](const Watched&) { return largest_volume_error; }},
      Alarm{"liquid volume", parts::interface, "liquid is lost or made",
            [](const Watched& w) { return w.monitors.liquid_volume_error(); },
            [](const Watched&) { return largest_volume_error; }},
      Alarm{"solid fraction", parts::solid_pressure, "denser than contact.solid_fraction_max",
            [](const Watched& w) { return w.monitors.solid_fraction_max(); },
            [](const Watched& w) {
              // a cell's volume is solved to that
              return w.scene.contact.solid_fraction_max + w.scene.numerics.volume_tolerance;
            }},
      Alarm{"negative fraction", parts::grains_transport, "a cell holds less than nothing",
            [](const Watched& w) { return -w.monitors.solid_fraction_min(); },
            [](const Watched&) { return -lowest_fraction; }},
      Alarm{"energy residual", parts::ledger,
            "momentum or continuity is not solved well enough, or an operator misstates its work: the energy "
            "budget does not close",
            share_of_residual, [](const Watched&) { return largest_energy_residual; }},
      Alarm{"energy created", parts::ledger,
            "numerics or the uncharged work of P_s^EF give the flow energy from nothing",
            [](const Watched& w) { return energy_created(w.scene, w.state.energy); },
            [](const Watched&) { return largest_energy_created; }},
      Alarm{"energy destroyed", parts::ledger, "numerics take more of the flow's energy than all else does",
            [](const Watched& w) { return energy_destroyed(w.scene, w.state.energy); },
            [](const Watched&) { return largest_energy_destroyed; }, most_destroyed},
      Alarm{"elastic start", parts::solid_pressure,
            "the bed starts so dense that its contacts hold more energy than its height: it springs apart, "
            "and how far depends on contact.stiffness and on the first steps",
            [](const Watched& w) {
              return w.start.elastic / std::max(energy_of_bed(w.scene), least_energy(w.scene, w.start));
            },
            [](const Watched&) { return largest_elastic_start; }},
      Alarm{
          "outlet load", parts::outlet,
          "grains lean on an outlet, which holds them: they leave at the speed at which they arrive, not by "
          "their own weight",
          [](const Watched& w) { return w.monitors.outlet_load() / scales_of(w.scene).pressure; },
          [](const Watched&) { return largest_outlet_load; }},
      Alarm{"granular bounds", parts::granular_temperature, "Theta runs into its stated bounds",
            [](const Watched& w) { return w.state.energy.theta_bounds / w.turnover; },
            [](const Watched&) { return largest_share_of_bounds; }},
      Alarm{"friction solves", parts::friction, "friction solves did not converge",
            [](const Watched& w) { return static_cast<double>(w.counts.unconverged_friction); },
            [](const Watched& w) {
              return std::max(1.0, unconverged_share * static_cast<double>(w.counts.steps));
            }},
      Alarm{"refused steps", parts::time_step,
            "steps are tried in vain: numerics.newton_max, cfl or dt_max do not suit the flow",
            [](const Watched& w) { return static_cast<double>(w.counts.refused); },
            [](const Watched& w) {
              return std::max(few_refused,
                              refused_share * static_cast<double>(w.counts.steps + w.counts.refused));
            }},
  };
  return all;
}

std::string Alarms::check(const State& s, const Monitors& monitors, const StepCounts& counts) {
  const EnergyTerms& e = s.energy;
  const Watched watched{scene_, start_, s, energy_turnover(scene_, start_, e), monitors, counts};
  for (const Alarm& alarm : list()) watch(alarm, watched);
  // In an inclined tank the potential counts from the upper end and may be negative: its size is what counts.
  const double given =
      std::fabs(start_.stored()) + e.walls + std::max(-e.outflow, 0.0) + least_energy(scene_, start_);
  if (e.in_motion() > energy_that_stops * given &&
      e.in_motion() > energy_that_stops * (given + energy_of_slide(scene_, monitors, s)))
    return fmt::format("blow-up: {:.3g} J in motion at t = {:.6g} s, and the run was given {:.3g} J",
                       e.in_motion(), s.time, given);
  return {};
}

}  // namespace granvof
