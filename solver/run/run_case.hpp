// Runs a scene from its start (or a checkpoint) to its end and writes the run directory.
#pragma once

#include <filesystem>
#include <string>

#include "solver/scene/scene.hpp"

namespace granvof {

struct RunOptions {
  std::filesystem::path out;  // run directory
  std::string command;        // the command line, for run.json
  int threads = 1;            // >= 1
  bool resume = false;        // go on from the directory's checkpoint
  bool force = false;         // replace the run of another case in the directory
  bool progress = true;       // a progress line on stderr (the caller says whether it is a terminal)
};

// Returns the exit code: 0 finished; 1 failed, or stopped by a signal (INT, TERM, HUP, USR1, XCPU, PIPE: the
// last good state is in the checkpoint); where, why and what can be resumed is on stderr and in run.json.
// Throws OutputError for a directory that cannot be used or resumed.
int run_case(const Scene& scene, const RunOptions& options);

}  // namespace granvof
