// Implicit part of the solid's momentum (6): friction, kinetic viscosity and drag of u_s with the old
// pressure gradients, the fluid eliminated face by face:
//   (m_s + beta_eff) u_s - div(stress of u_s) = m_s u_s* + beta_eff u_c* - f_s grad P_c - grad P_s,
//   beta_eff = beta m_c / (m_c + beta), m = (phase mass) / dt, * the predictors,
// and then u_c = (m_c u_c* + beta u_s) / (m_c + beta).
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/operators/friction.hpp"
#include "solver/operators/interphase_drag.hpp"
#include "solver/operators/momentum_predictor.hpp"

namespace granvof {

class SolidMomentum {
 public:
  SolidMomentum(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // u_s, u_c and u_strain of `next`, from the old state with ghosts filled and what is known of its level.
  linear::Report solve(double dt, const State& now, const MomentumPredictor& predicted,
                       const FaceInertia& inertia, const InterphaseDrag& drag, const Rheology& rheology,
                       const Aperture& aperture, State& next);

  // Power of the stress of the last solve, see Friction::power(); `next` after the whole step.
  Friction::Power power(const State& next, Field& kinetic) {
    return friction_.power(balance_.mass, next, kinetic);
  }

 private:
  double kinetic_energy(const FaceInertia& inertia, const State& next) const;  // of the grains [J]
  void set_balance(double dt, const State& now, const MomentumPredictor& predicted,
                   const FaceInertia& inertia, const InterphaseDrag& drag, const Aperture& aperture,
                   State& next);
  void recover_fluid(double dt, const MomentumPredictor& predicted, const FaceInertia& inertia,
                     const InterphaseDrag& drag, State& next) const;

  const Grid& grid_;
  const Boundary& boundary_;
  Friction friction_;
  SolidBalance balance_;
  // Of a grain in its fluid, by Stokes [s]. Within a step that is longer grains have no inertia to be late
  // by: what holds them is the rate of shear, of which the viscosities of the step before know enough.
  double relaxation_;
};

}  // namespace granvof
