// Starting another program and waiting for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace granvof::compare {

struct Ended {
  int code = -1;           // exit code, or 128 + signal
  bool timed_out = false;  // ended here, after `timeout`
};

// Runs `command` (program and arguments, no shell), its output going to `log`, and waits. After `timeout`
// seconds it is ended. Throws std::runtime_error where it cannot be started.
Ended run_program(const std::vector<std::string>& command, const std::filesystem::path& log, double timeout);

}  // namespace granvof::compare
