// Granular temperature Theta: transport (7), its steady local balance (algebraic form), or none.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/linear/scalar_solver.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/strain.hpp"

namespace granvof {

// What the fluctuation energy 3/2 f_s rho_s Theta of the whole grid lost in a step [J].
struct GranularLosses {
  double collisions = 0.0;  // gamma_s^K of (23)
  double drag = 0.0;        // 3 beta Theta
  double bounds = 0.0;      // taken away by the two stated bounds on Theta, see granular_temperature.cpp
};

class GranularTemperature {
 public:
  GranularTemperature(const Grid& grid, const Scene& scene, const Boundary& boundary,
                      const Communicator& communicator);

  // Theta of the new level [m2/s2], >= 0 without clipping. In: Theta, f_s of the old level (one ghost layer
  // filled), f_s and strain of the new level, flux_s [m/s], beta on faces, e of the step.
  GranularLosses advance(double dt, const Field& theta, const Field& f_s, const Field& f_s_new,
                         const FaceField& flux_s, const FaceField& beta, const Rheology& rheology,
                         const StrainRate& strain, Field& theta_new);

 private:
  void convect(double dt, const Field& theta, const Field& f_s, const Field& f_s_new, const FaceField& flux_s,
               Field& theta_new) const;
  void conduct(double dt, const Field& f_s_new, const Rheology& rheology, Field& theta_new);
  GranularLosses balance(double dt, const Field& f_s_new, const FaceField& beta, const Rheology& rheology,
                         const StrainRate& strain, Field& theta_new);

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  linear::ScalarSolver solver_;
  FaceField conductivity_;
  Field kappa_, mass_, rhs_;
  Field collisions_, drag_, excess_;  // losses of the step [J/m3]
};

}  // namespace granvof
