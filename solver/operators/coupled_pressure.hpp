// Implicit step of the two pressures: one coupled Newton system for (P_c, P_s).
//
// Finds P_c and P_s so that the corrected velocities satisfy continuity (4), div(f_s u_s + f_c u_c) = 0, and
// the solid volume balance (1) closes with the law P_s = P_s(f_s) at the new level. Drag acts inside the
// correction: a face's 2x2 system couples both phases' response to both gradients. Elastic waves of the
// contact pressure (13) and drag therefore do not bound the time step. P_s moves nothing where next to no
// grains are (solid_that_counts): the second row is that of the box around the others, and beyond it P_s
// follows from the law. With explicit contact pressure P_s is
// that of the old f_s and only continuity is solved for: the comparison that shows what the coupling is
// worth.
// Equations: docs/theory/balances.md, docs/theory/contact.md.
#pragma once

#include <string>

#include "solver/closures/solid_pressure.hpp"
#include "solver/grid/boundary.hpp"
#include "solver/linear/coupled_solver.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/box_of_grains.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/solid_fraction_flux.hpp"

namespace granvof {

struct PressureReport {
  bool converged = false;
  int newton = 0;           // Newton iterations
  int linear = 0;           // BiCGSTAB iterations, all Newton iterations together
  double mismatch = 0.0;    // largest distance of (f_s, P_s) from the law, in solid fraction [-]
  double divergence = 0.0;  // largest |div(f_s u_s + f_c u_c)| dt [-]
};

class CoupledPressure {
 public:
  // The law, as all else, must outlive this.
  CoupledPressure(const Grid& grid, const Scene& scene, const Boundary& boundary,
                  const closures::SolidLaw& law);

  // In: the old state with ghosts filled, the rheology, inertia and beta [kg/m3 s] of its level; in `next`
  // the predicted u_s, u_c (old pressure gradients included), the old p_c, p_s, and the packing at which the
  // grains touch. Out: new u_s, u_c on their faces, p_c, p_s, and the volume fluxes per area f_s u_s and
  // f_c u_c [m/s] through every face that close both balances.
  PressureReport solve(double dt, const State& now, const Rheology& rheology, const FaceInertia& inertia,
                       const FaceField& beta, const Aperture& aperture, State& next, FaceField& flux_s,
                       FaceField& flux_c);

 private:
  bool is_implicit() const { return scene_.numerics.contact_pressure == ContactPressure::implicit; }
  double least_pushed() const;
  Range pushed_faces(int d) const;
  void set_response(double dt, const FaceInertia& inertia, const FaceField& beta, const Aperture& aperture);
  void set_fluxes(double dt, const Field& f_s, bool new_directions);
  void set_balances(double dt, const Field& f_s, const Field& p_s, const FaceField& us_predicted,
                    const FaceField& uc_predicted);
  void correct(double dt, const Field& f_s, const FaceField& us_predicted, const FaceField& uc_predicted,
               FaceField& flux_s, FaceField& flux_c);
  void extrapolate_points(double dt, const Field& f_s, const FaceField& u_s_old);
  void linearise(const State& now, const Field& packing, const Rheology& rheology);
  double turned_flux(double dt, const Field& f_s);
  double move_points(double dt, const State& now, const Field& packing, const Rheology& rheology);
  void set_pressures(double dt, const State& now, const Rheology& rheology, const FaceField& flux_s,
                     State& next);
  linear::CoupledSystem system() const;

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  const closures::SolidLaw& law_;
  double load_;  // scale of P_s [Pa], see scales.hpp
  linear::CoupledSolver solver_;
  SolidFractionFlux fraction_;
  bool holds_grains_ = true;            // of the step, see FaceInertia
  Range pushed_{{0, 0, 0}, {0, 0, 0}};  // cells whose P_s moves grains; the second row is theirs

  // 2x2 response of a face: [du_s; du_c] = -response [grad dP_c; grad dP_s]
  FaceField us_by_pc_, us_by_ps_, uc_by_pc_, uc_by_ps_;
  FaceField k11_, k12_, k21_, k22_;    // response of the fluxes (total, solid), divided by h^2
  FaceField f_upwind_s_, f_upwind_c_;  // fractions the fluxes carry
  FaceField us_, uc_;                  // velocities of the present iterate
  Field m11_, m22_, rhs1_, rhs2_, dp_c_, dp_s_;
  Field point_f_, point_p_, slope_;  // linearisation point of P_s(f_s) in the cells of the second row
  Field f_new_;
  Field present_;  // fraction by the present direction of flow
};

}  // namespace granvof
