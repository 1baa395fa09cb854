// One recording: prepare, hold, release, run, write.
#pragma once

#include <filesystem>
#include <string>

#include "solver/scene/scene.hpp"

namespace demvof {

struct RecordOptions {
  std::filesystem::path out;      // run directory
  std::filesystem::path scratch;  // for OpenFOAM's and LIGGGHTS' files and prepared columns
  unsigned seed = 1;
  bool gate_closed = false;  // control run: the gate stays where it is
  std::string command;       // for the record
  bool progress = false;     // a line on stderr
  bool force = false;        // replace a run of another case in the run directory
};

// Returns the program's exit code: 0 done, 1 failed (run.json says when and why).
// Throws granvof::CaseError for what demvof cannot compute, granvof::OutputError, std::runtime_error.
int record_scene(const granvof::Scene& scene, const RecordOptions& options);

}  // namespace demvof
