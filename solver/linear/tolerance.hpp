// When an iterative solve stops, and what it reports. Norms are the largest absolute value of the residual.
#pragma once

namespace granvof::linear {

// Converged: |residual| <= max(absolute, relative * |initial residual|).
struct Tolerance {
  double absolute = 0.0;     // in the units of the right-hand side
  double relative = 1e-6;    // of the residual of the first guess
  int max_iterations = 200;  // applications of the preconditioner
};

struct Report {
  int iterations = 0;      // applications of the preconditioner
  double initial = 0.0;    // true residual of the first guess
  double final = 0.0;      // true residual of the answer, recomputed from it
  bool converged = false;  // judged by the true residual; false also when anything is not finite
};

}  // namespace granvof::linear
