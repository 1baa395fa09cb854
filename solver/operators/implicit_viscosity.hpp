// Implicit viscosity of the continuous phase, for steps that the explicit diffusion term of (5) would not
// bear.
//
// The explicit step left u_c and u_s; what implicit diffusion changes of them, drag included (face by face),
// is
//   m_c dc = D (u_c + dc - u_c^n) + beta (ds - dc),   m_s ds = beta (dc - ds),   m = (phase mass) / dt,
//   D v = div(f_c (mu_c + mu_t) grad v), its normal part twice.
// With ds eliminated, b = beta m_s / (m_s + beta), and v = u_c + dc - u_c^n the increment of the whole step:
//   (m_c + b) v - D v = (m_c + b) (u_c - u_c^n).
// Both phases change together, or grains with strong drag would keep the explicit term's kick (seen in
// cases/sedimentation: odd-even velocities of 1 cm/s). A flow that the explicit terms hold steady stays as it
// is. The transposed gradient stays explicit: it is never larger than what D damps. One component at a time,
// by CG with multigrid.
// Equations: docs/theory/balances.md.
#pragma once

#include <vector>

#include "solver/grid/boundary.hpp"
#include "solver/linear/scalar_solver.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/mixture.hpp"

namespace granvof {

class ImplicitViscosity {
 public:
  ImplicitViscosity(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // `viscosity`: f_c (mu_c + mu_t) of the cells [Pa s], ghosts filled; u_old: u_c^n. u_c and u_s change on
  // the open faces of the fluid and on those that hold grains; `predicted_c` gains what the force does to the
  // fluid alone, so that it stays the predictor of all viscous forces. False if a component did not converge.
  bool apply(double dt, const Field& viscosity, const FaceInertia& inertia, const FaceField& beta,
             const Aperture& aperture, const FaceField& u_old, FaceField& predicted_c, FaceField& u_c,
             FaceField& u_s);

 private:
  void set_system(int d, double dt, const Field& viscosity, const FaceInertia& inertia, const FaceField& beta,
                  const Aperture& aperture);
  void set_sides(int d, int e, const double* edge);

  const Grid& grid_;
  const Boundary& boundary_;
  double least_velocity_;                     // that the solve leaves [m/s]
  std::vector<linear::ScalarSolver> solver_;  // one a component
  Field open_;                                // 1 where the component is unknown or its ghost has no gradient
  Field edge_;                                // viscosity on the edges of one plane [Pa s]
  FaceField coefficient_;                     // of one component, by direction [kg/m3 s]
  Field mass_, diagonal_, rhs_, increment_;
};

}  // namespace granvof
