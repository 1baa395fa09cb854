// Liquid volume balance (2) in its form (24): a face value of alpha (CICSAM, or upwind) times the SAME f_c
// u_c flux as in continuity; or the geometric flux of plic_transport.hpp, where the scene says so.
//
// A flux-corrected step keeps 0 <= f_l <= f_c without clipping, and with it the gas (3), which is what is
// left: CICSAM's flux is the upwind flux plus a correction, and the correction is limited where it would
// leave the bounds. Where the interface moves more than a fifth of a cell a step, the step is divided. Known
// problem: the shape error follows the Courant number; a disc advected diagonally on 32 cells across the box
// errs by 0.26 of its area at 0.2 a direction, 0.10 at 0.1, 0.06 at 0.05.
// Equations: docs/theory/balances.md.
#pragma once

#include <optional>

#include "solver/operators/plic_transport.hpp"

namespace granvof {

class InterfaceTransport {
 public:
  InterfaceTransport(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // alpha of `next` from alpha and f_s of `now` (two ghost layers filled) and flux_c [m/s].
  // Returns what passed the faces, valid until the next call.
  const LiquidPassed& advance(double dt, const State& now, const FaceField& flux_c, State& next);

 private:
  int substeps(double dt, const State& now, const FaceField& flux_c);
  void interface_normal(const Field& alpha);
  void face_alpha(int d, const Field& alpha, const FaceField& flux_c);
  void limit_corrections(double dt);
  void substep(double dt, const FaceField& flux_c, Field& alpha);

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  Field liquid_;
  Field f_c_, f_c_end_;  // at the start and at the end of a substep [-]
  Field courant_, gain_, loss_;
  FaceField slope_;       // grad alpha, component by component
  FaceField correction_;  // CICSAM flux minus upwind flux [m/s]
  LiquidPassed passed_;
  std::optional<PlicTransport> plic_;
};

}  // namespace granvof
