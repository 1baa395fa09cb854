// Signals that ask a run to end: from a terminal, a shell, a scheduler before it kills, or a reader of our
// messages that has gone. They are remembered, and the run ends at its next step with its state written.
#pragma once

#include <stdexcept>
#include <string>

namespace granvof {

// From here on every signal that would end the program, but for KILL and those that tell of a fault in it
// (SEGV, ABRT, ...), is remembered instead, and none is yet: TERM, INT, HUP, QUIT, USR1, USR2, XCPU, PIPE,
// the timers and others. One that the caller had ignored (nohup, a shell's background) stays ignored, but
// PIPE: that is how the run learns that nobody reads it. One for which something else in the program listens
// (a profiler) is left to it. One that the caller had blocked is let through.
void listen_to_stop_signals();

// The number of the last one that has come since; 0 where none has.
int stop_signal();
// "stopped by a signal (SIGTERM)" of a number that stop_signal() gave; empty of 0.
std::string stop_reason(int number = stop_signal());

// Thrown out of long work that has no steps of its own to end at.
class StopRequested : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Throws StopRequested with stop_reason() where there is one.
void throw_if_stopped();

}  // namespace granvof
