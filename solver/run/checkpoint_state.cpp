#include "solver/run/checkpoint_state.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "solver/output/output_error.hpp"
#include "solver/scene/printable.hpp"

namespace granvof {
namespace {

constexpr std::size_t longest_name = 80;  // bytes, in a message

template <typename Counters, typename Visit>
void for_each_counter(Counters& c, Visit&& visit) {
  visit("steps", c.steps);
  visit("refused_steps", c.refused_steps);
  visit("newton", c.newton);
  visit("linear", c.linear);
  visit("friction", c.friction);
  visit("unconverged_friction", c.unconverged_friction);
}

// What this program would not write it does not know: a state that lacks it goes on as another.
template <typename Saved, typename Known>
void refuse_unknown(const Saved& saved, const Known& known, const char* kind, const Checkpoint& from) {
  for (const auto& [name, value] : saved)
    if (!known.contains(name))
      throw OutputError("resume from", from.file,
                        fmt::format("it has a {} '{}', which this program does not know", kind,
                                    case_file::printable(name, longest_name)));
}

}  // namespace

CheckpointView checkpoint_view(const Grid& grid, const State& s, const StepControl& control,
                               const Monitors& monitors, const RunCounters& counters,
                               const RunProgress& progress) {
  CheckpointView view;
  view.time = s.time;
  for_each_field(grid, s, [&](const FieldOfState& of, const Field& f) { view.arrays[of.key()] = f.span(); });
  for_each_counter(counters, [&](const char* name, std::int64_t value) { view.counters[name] = value; });
  const Monitors::Values v = monitors.values();
  view.scalars = {{"last_dt", control.last()},
                  {"wall_seconds", progress.wall_seconds},
                  {"core_seconds", progress.core_seconds},
                  {"solid_volume", v.solid_volume},
                  {"liquid_volume", v.liquid_volume},
                  {"liquid_left", v.liquid_left},
                  {"solid_left", v.solid_left},
                  {"solid_error", v.solid_error},
                  {"liquid_error", v.liquid_error},
                  {"solid_max", v.solid_max},
                  {"solid_min", v.solid_min}};
  for (const EnergyTerm& term : energy_terms) view.scalars[term.name] = s.energy.*term.value;
  return view;
}

void restore(const Checkpoint& saved, const Grid& grid, State& s, StepControl& control, Monitors& monitors,
             RunCounters& counters) {
  s.time = saved.time;
  for_each_field(grid, s, [&](const FieldOfState& of, Field& f) {
    const std::vector<double>& values = saved.array(of.key(), f.span().size());
    std::copy(values.begin(), values.end(), f.span().begin());
  });
  for (const EnergyTerm& term : energy_terms) s.energy.*term.value = saved.scalar(term.name);
  for_each_counter(counters, [&](const char* name, std::int64_t& value) { value = saved.counter(name); });
  counters.wall_seconds = saved.scalar("wall_seconds");
  counters.core_seconds = saved.scalar("core_seconds");
  control.restore(saved.scalar("last_dt"));
  monitors.restore({saved.scalar("solid_volume"), saved.scalar("liquid_volume"), saved.scalar("liquid_left"),
                    saved.scalar("solid_left"), saved.scalar("solid_error"), saved.scalar("liquid_error"),
                    saved.scalar("solid_max"), saved.scalar("solid_min")});
  const CheckpointView known = checkpoint_view(grid, s, control, monitors, counters, {});
  refuse_unknown(saved.arrays, known.arrays, "array", saved);
  refuse_unknown(saved.scalars, known.scalars, "scalar", saved);
  refuse_unknown(saved.counters, known.counters, "counter", saved);
}

}  // namespace granvof
