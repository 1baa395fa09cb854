// Conjugate gradients in double precision, preconditioned by one multigrid V-cycle in single precision.
#pragma once

#include <array>

#include "solver/grid/layout.hpp"
#include "solver/grid/memory.hpp"
#include "solver/linear/faces.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/linear/padded_layout.hpp"
#include "solver/linear/tolerance.hpp"

namespace granvof::linear {

class ScalarSolver {
 public:
  // Systems whose arrays all have `layout`. `spacing` as in Multigrid.
  explicit ScalarSolver(const Layout& layout, const std::array<double, 3>& spacing = {1.0, 1.0, 1.0},
                        int smoothing = 2);

  // Solves mass x + sum over faces of a (x - x_neighbour) = rhs; x is the guess on entry. With mass 0
  // everywhere and no open end the matrix is singular: rhs must then sum to 0, and x is one of the solutions.
  // Ghosts of all arrays are neither read nor written.
  Report solve(const Faces& faces, const double* mass, const double* rhs, double* x,
               const Tolerance& tolerance);

 private:
  double true_residual(const Faces& faces, const double* mass, const double* rhs, const double* x);
  double multiply(const Faces& faces, const double* mass);
  void combine(const float* z, double beta);
  double advance(double alpha, double* x);
  void scale_residual();

  Layout user_;
  int smoothing_;
  Multigrid multigrid_;
  Layout layout_;  // padded, of everything below; that of the finest level
  std::array<bool, 3> coupled_{};
  Buffer<double> zeros_;  // coefficients of the faces above the last row
  // What r is multiplied by before it becomes single precision: 1 over its largest value at the last
  // (re)start, as squares of small residuals, say of a Theta of 1e-15 m2/s2, would underflow.
  double unit_ = 1.0;
  Buffer<double> r_, q_, guess_;
  Buffer<float> p_;
};

}  // namespace granvof::linear
