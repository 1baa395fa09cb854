// Granular temperature Theta: transport (7), its steady local balance (algebraic form), or none.
//
// Theta lives on what the kinetic stress (16) dissipates, and that stress is as large as Theta makes it. So a
// step takes Theta twice: the old one, predicted where grains begin to shear, for the viscosity of the
// friction step, and the new one from the power that this stress then spent, cell by cell. What the grains'
// mean motion loses is what their fluctuation gains. (With production from the new strain and the new Theta,
// and stress from the old one, collisions dissipated 127 times the fall of a dry column on cells of 0.4 grain
// diameters.)
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <optional>

#include "solver/closures/collisions.hpp"
#include "solver/grid/boundary.hpp"
#include "solver/linear/scalar_solver.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/strain.hpp"

namespace granvof {

// What the fluctuation energy 3/2 f_s rho_s Theta of the whole grid lost in a step [J].
struct GranularLosses {
  double collisions = 0.0;  // gamma_s^K of (23), and what bumps of walls take
  double drag = 0.0;        // 3 beta Theta
  double pressure = 0.0;    // P_s^K div u_s: what Theta pays for the work of the kinetic pressure
  double bounds = 0.0;      // taken away by the two stated bounds on Theta, see granular_temperature.cpp
  double run_out = 0.0;     // held where no grains are left to hold it
  double spared = 0.0;      // not taken where it should have lost more than it held; of a Theta in steady
                            // balance all that it gained
};

class GranularTemperature {
 public:
  // The laws, as all else, must outlive this.
  GranularTemperature(const Grid& grid, const Scene& scene, const Boundary& boundary,
                      const closures::Collisions& laws);

  // Theta that the kinetic viscosity of the step is taken at [m2/s2]: the old one, but at least a small share
  // of what the strain would make in each cell by itself within dt, nothing carried; in the algebraic form
  // all of that. In: the state, e and strain of the old level, beta of cells. Interior cells only.
  void predict(double dt, const State& now, const Field& beta, const Field& restitution,
               const StrainRate& strain, Field& predicted) const;

  // Theta of the new level [m2/s2], >= 0 without clipping, into `next`. In: the old state (one ghost layer
  // filled), f_s and strain of the new level, flux_s [m/s], beta of cells, e of the step, and what the
  // kinetic stress dissipated, production >= 0 [W/m3].
  GranularLosses advance(double dt, const State& now, const FaceField& flux_s, const Field& beta,
                         const Rheology& rheology, const StrainRate& strain, const Field& production,
                         State& next);

 private:
  // All on `cells_`. Returns what was held where no grains are left [J].
  double convect(double dt, const State& now, const FaceField& flux_s, State& next) const;
  void conduct(double dt, const Rheology& rheology, State& next);
  GranularLosses balance(double dt, const State& now, const Field& beta, const Field& restitution,
                         const StrainRate& strain, const Field& production, State& next);

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  const closures::Collisions& laws_;
  Field wall_loss_;  // bumpy_wall_loss() per height of the cells beside bumps [1/m]; empty without
  Range cells_{{0, 0, 0}, {0, 0, 0}};           // around those that hold grains before or after the step
  std::optional<linear::ScalarSolver> solver_;  // of cells_
  FaceField conductivity_;
  Field kappa_, mass_, rhs_;
};

}  // namespace granvof
