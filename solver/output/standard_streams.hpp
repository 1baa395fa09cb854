// Standard streams of a program, which its caller may have closed or pointed at a full disk.
#pragma once

namespace granvof {

// A file that may not grow (ulimit -f), standard output above all, shows as a failed write and does not end
// the program (SIGXFSZ). The first call of a main(). A program that calls it has /dev/null on every standard
// stream that its caller has closed, from before its libraries begin on: the stream's number would be that of
// the next file opened, and messages would go into a result. What is then read or written there fails, but
// for messages.
void prepare_standard_streams();

// Throws std::runtime_error where something of what went to stdout was not written: what nobody could read
// was not said. The last call of a main().
void require_stdout_written();

}  // namespace granvof
