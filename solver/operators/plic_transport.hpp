// Liquid volume balance (24) with a geometric flux: a plane in every cell of the interface (PLIC), one
// direction after the other.
//
// The normal is Youngs' (differences over 3 x 3 (x 3) cells), the flux is the liquid in the part of the donor
// that the continuous phase leaves through the face: what a cell loses through two faces comes from two
// separate parts of it, so that 0 <= f_l <= f_c holds without a limiter. f_c goes through the same sweeps,
// which keeps a uniform alpha uniform. Sweeps are x y x (x y z y x in 3D), the outer ones over half the step:
// no direction is preferred from step to step, and a run needs no memory of the last order.
// Sources: Youngs 1982 (in Numerical Methods for Fluid Dynamics, Academic Press); Weymouth & Yue 2010, J.
// Comput. Phys. 229, 2853, for what split sweeps owe to conservation; Strang 1968, SIAM J. Numer. Anal. 5.
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/liquid_passed.hpp"
#include "solver/operators/plane_in_cell.hpp"
#include "solver/state/state.hpp"

namespace granvof {

class PlicTransport {
 public:
  PlicTransport(const Grid& grid, const Boundary& boundary);

  // alpha of `next` from alpha and f_s of `now` (ghosts filled) and flux_c [m/s]. What passes the faces is
  // added to `passed`.
  void advance(double dt, const State& now, const FaceField& flux_c, State& next, LiquidPassed& passed);

 private:
  void sweep(int d, double dt, const FaceField& flux_c, Field& alpha, LiquidPassed& passed);

  const Grid& grid_;
  const Boundary& boundary_;
  Field f_c_, flux_;
};

}  // namespace granvof
