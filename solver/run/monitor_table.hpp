// What a run says of itself beside its fields and its energy: the one table of these monitors.
#pragma once

#include <span>

#include "solver/run/time_loop.hpp"

namespace granvof {

// What monitors are read from; `start` is the energy of the scene's start, whatever it is resumed from.
struct RunSoFar {
  const TimeLoop& loop;
  const Scene& scene;
  const EnergyTerms& start;
};

struct MonitorEntry {
  const char* name;  // column of series.csv, key of run.json
  const Part& part;  // of whose work it speaks
  const char* unit;
  const char* meaning;
  double (*value)(const RunSoFar&);
};

// Columns of series.csv, in their order; the terms of the energy follow them.
std::span<const MonitorEntry> monitors_of_a_step();
// In run.json under `monitors`, with the terms of the energy.
std::span<const MonitorEntry> monitors_of_a_run();

}  // namespace granvof
