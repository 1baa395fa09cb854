#include "solver/run/monitor_table.hpp"

#include <algorithm>
#include <array>

#include "solver/run/alarms.hpp"

namespace granvof {
namespace {

// Of a step [-].
double mean_of(const RunSoFar& run, std::int64_t RunCounters::*count) {
  const RunCounters& counters = run.loop.counters();
  return static_cast<double>(counters.*count) / std::max<double>(1.0, static_cast<double>(counters.steps));
}

}  // namespace

std::span<const MonitorEntry> monitors_of_a_step() {
  static constexpr std::array list{
      MonitorEntry{"dt", parts::time_step, "s", "last time step",
                   [](const RunSoFar& run) { return run.loop.last_dt(); }},
      MonitorEntry{
          "newton", parts::pressure, "-", "Newton iterations of the last step",
          [](const RunSoFar& run) { return static_cast<double>(run.loop.last_step().pressure.newton); }},
      MonitorEntry{
          "linear", parts::pressure, "-", "iterations of the coupled pressure solver in the last step",
          [](const RunSoFar& run) { return static_cast<double>(run.loop.last_step().pressure.linear); }},
      MonitorEntry{
          "friction_iterations", parts::friction, "-", "iterations of the friction solver in the last step",
          [](const RunSoFar& run) { return static_cast<double>(run.loop.last_step().friction.iterations); }},
      MonitorEntry{"solid_volume_error", parts::grains_transport, "-",
                   "largest relative change of the solid volume so far",
                   [](const RunSoFar& run) { return run.loop.monitors().solid_volume_error(); }},
      MonitorEntry{"liquid_volume_error", parts::interface, "-",
                   "largest relative change of the liquid volume so far, outflow accounted for",
                   [](const RunSoFar& run) { return run.loop.monitors().liquid_volume_error(); }},
  };
  return list;
}

std::span<const MonitorEntry> monitors_of_a_run() {
  static constexpr std::array list{
      MonitorEntry{"newton_per_step", parts::pressure, "-", "Newton iterations of a step, mean",
                   [](const RunSoFar& run) { return mean_of(run, &RunCounters::newton); }},
      MonitorEntry{"linear_per_step", parts::pressure, "-",
                   "iterations of the coupled pressure solver in a step, mean",
                   [](const RunSoFar& run) { return mean_of(run, &RunCounters::linear); }},
      MonitorEntry{"friction_per_step", parts::friction, "-",
                   "iterations of the friction solver in a step, mean",
                   [](const RunSoFar& run) { return mean_of(run, &RunCounters::friction); }},
      MonitorEntry{
          "unconverged_friction_solves", parts::friction, "-", "friction solves that did not converge",
          [](const RunSoFar& run) { return static_cast<double>(run.loop.counters().unconverged_friction); }},
      MonitorEntry{"last_dt", parts::time_step, "s", "last time step",
                   [](const RunSoFar& run) { return run.loop.last_dt(); }},
      MonitorEntry{
          "energy_turnover", parts::ledger, "J",
          "energy that the run turned over, which its errors are shares of",
          [](const RunSoFar& run) { return energy_turnover(run.scene, run.start, run.loop.now().energy); }},
      MonitorEntry{"energy_created", parts::ledger, "-",
                   "what numerics, and work that nothing pays for, gave the flow, as a share of what it was "
                   "given otherwise",
                   [](const RunSoFar& run) { return energy_created(run.scene, run.loop.now().energy); }},
      MonitorEntry{"energy_destroyed", parts::ledger, "-",
                   "what numerics took from the flow, as a share of all that became of its energy",
                   [](const RunSoFar& run) { return energy_destroyed(run.scene, run.loop.now().energy); }},
  };
  return list;
}

}  // namespace granvof
