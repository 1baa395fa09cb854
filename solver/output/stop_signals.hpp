// Signals that ask a run to end: from a terminal, a shell, a scheduler before it kills, or a reader of our
// messages that has gone. They are remembered, and the run ends at its next step with its state written.
#pragma once

#include <stdexcept>
#include <string>

namespace granvof {

// From here on INT, TERM, HUP, USR1, XCPU and PIPE are remembered instead of ending the program, and none is
// yet. One that the caller had ignored (nohup, a shell's background) stays ignored, but PIPE: that is how the
// run learns that nobody reads it. One that the caller had blocked is let through. XFSZ is ignored: a file
// that may not grow shows as a failed write.
void listen_to_stop_signals();

// The number of the last one that has come since; 0 where none has.
int stop_signal();
// "stopped by a signal (SIGTERM)" where one has come since; empty where none has.
std::string stop_reason();

// Whether that signal was XCPU: the limit of the CPU time.
bool stopped_at_cpu_limit();

// Thrown out of long work that has no steps of its own to end at.
class StopRequested : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Throws StopRequested with stop_reason() where there is one.
void throw_if_stopped();

}  // namespace granvof
