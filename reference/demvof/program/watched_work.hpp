// Work in libraries that may end the program: LIGGGHTS calls exit or MPI_Abort where it finds an error,
// OpenFOAM abort.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <sys/types.h>

namespace demvof {

struct WorkEnd {
  std::optional<int> code;  // what the work returned; none where its process was ended from within
  std::string how;          // then: "exit code 1", "signal 6 (Aborted)", or why there was no process
  pid_t process = 0;        // that did it
};

// Does `work` in a copy of this process and waits for its end. Signals that ask this process to end
// (stop_signals.hpp, which must be listened to) are passed on. The copy does not outlive this process; what
// it changes in memory is lost. MPI must not have been started: `work` starts its own.
WorkEnd work_in_own_process(const std::function<int()>& work);

// One sentence on an end from within: what LIGGGHTS says of it in its log, which is then removed from
// `scratch`.
std::string reason_of(const WorkEnd& end, const std::filesystem::path& scratch);

}  // namespace demvof
