// The unit in which costs of different machines are compared: a small kernel, timed beside each run.
#pragma once

namespace granvof::compare {

// CPU seconds of one work unit on this machine now [core-s], > 0: 10^8 cell updates of a five-point Laplacian
// on 256 x 256 doubles (1 MB, in the second-level cache as a small scene is). Takes about a tenth of a
// second.
double work_unit_seconds();

// CPU time of this thread [s].
double thread_seconds();

}  // namespace granvof::compare
