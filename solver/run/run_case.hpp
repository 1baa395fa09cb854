// Runs a scene from its start (or a checkpoint) to its end and writes the run directory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "solver/grid/communicator.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

struct RunOptions {
  std::filesystem::path out;  // run directory
  std::string command;        // the command line, for run.json
  int threads = 1;            // >= 1
  bool resume = false;        // go on from the directory's checkpoint
  bool force = false;         // replace the run of another case in the directory
  bool progress = true;       // a progress line on stderr (the caller says whether it is a terminal)
  const Communicator* processes = nullptr;  // among which the tank is cut; none: this one alone
  std::optional<double> stop_after;         // wall-clock time of this part after which it is stopped [s]; > 0
};

// Of a run that was stopped by `stop_after`, after the step in which the time was up.
inline constexpr int exit_code_at_wall_clock_limit = 3;

// Returns the exit code: 0 finished; 3 stopped at its wall-clock limit; 1 failed, or stopped by a signal
// (INT, TERM, HUP, USR1, XCPU, PIPE: the last good state is in the checkpoint); where, why and what can be
// resumed is on stderr and in run.json. Throws OutputError for a directory that cannot be used or resumed,
// CaseError for a grid that does not fit into memory, and for a scene that so many processes cannot share.
// Of several processes the lowest decides and writes; all return its code.
int run_case(const Scene& scene, const RunOptions& options);

}  // namespace granvof
