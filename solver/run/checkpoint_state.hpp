// What a checkpoint holds of a run, and back.
#pragma once

#include <cstdint>

#include "solver/output/checkpoint.hpp"
#include "solver/output/run_record.hpp"
#include "solver/run/monitors.hpp"
#include "solver/run/step_control.hpp"

namespace granvof {

// Counts and marks of a run that are no part of the physical state.
struct RunCounters {
  std::int64_t steps = 0, refused_steps = 0, newton = 0, linear = 0, friction = 0, unconverged_friction = 0;
  double wall_seconds = 0.0, core_seconds = 0.0;  // of earlier parts of a resumed run
};

// The arrays point into `s`, which must outlive the view.
CheckpointView checkpoint_view(const Grid& grid, const State& s, const StepControl& control,
                               const Monitors& monitors, const RunCounters& counters,
                               const RunProgress& progress);

// Throws OutputError where the checkpoint lacks something, or holds what is not known. Ghosts of the state
// are not filled.
void restore(const Checkpoint& saved, const Grid& grid, State& s, StepControl& control, Monitors& monitors,
             RunCounters& counters);

}  // namespace granvof
