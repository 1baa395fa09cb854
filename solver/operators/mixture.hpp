// Density and viscosity of the continuous phase and the inertia of both phases on faces.
// Equations: docs/theory/balances.md.
#pragma once

#include <algorithm>

#include "solver/grid/field.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Below this solid fraction a face holds no grains: u_s is locked to u_c there.
inline constexpr double least_solid_fraction = 1e-6;
// Below this one u_s neither bounds a step nor has it refused, and P_s does not push: the grains of a face
// are those of the old level, and what a filling cell's pressure would make of next to none is no velocity.
inline constexpr double solid_that_counts = 1e-3;
// The same for steps of a scene whose bed is itself so dilute.
inline double solid_that_counts_in(const Scene& scene) {
  return std::min(solid_that_counts, scene.bed ? 0.01 * scene.bed->solid_fraction : solid_that_counts);
}

// rho_c = alpha rho_l + (1 - alpha) rho_g [kg/m3]; mu_c likewise [Pa s] (below eq (5)). Pure, cell by cell.
inline double mixture(double alpha, double liquid, double gas) {
  return alpha * liquid + (1.0 - alpha) * gas;
}

// f_c rho_c [kg/m3] that the velocity on a face between two cells moves: their mean room times their mean
// density, so that a step of P_c at rest does not depend on the grains in them. The mean of their f_c rho_c
// does, and where a level of water cuts a slope of grains no pressure would be at rest.
inline double face_mass(double f_s_a, double alpha_a, double f_s_b, double alpha_b, double liquid,
                        double gas) {
  return (1.0 - 0.5 * (f_s_a + f_s_b)) * mixture(0.5 * (alpha_a + alpha_b), liquid, gas);
}

// f_c rho_c [kg/m3] that the velocity on a side moves which passes the fluid: that of the half cell inside,
// so that what is beyond adds no weight; the mean where what waits beyond is heavier, which else would come
// in at the speed that its pressure gives to gas.
inline double passing_side_mass(double inside, double beyond) {
  return 0.5 * (inside + std::max(inside, beyond));
}

// Mass per volume on the faces: f_s rho_s [kg/m3] by the mean of the two cells (upwind values as inertia blow
// up) and f_c rho_c by face_mass(); on sides that pass the fluid those of the cell inside.
// Values reach one ghost layer; two of f_s and alpha must be filled.
struct FaceInertia {
  FaceField f_s;    // solid fraction on faces [-]
  FaceField solid;  // f_s rho_s [kg/m3]
  FaceField fluid;  // f_c rho_c [kg/m3]
  // Whether any cell has f_s other than 0, or what waits beyond a side: without grains their part of a step
  // makes nothing, and is left out.
  bool holds_grains = true;

  explicit FaceInertia(const Grid& grid) : f_s(grid), solid(grid), fluid(grid) {}
  void update(const Grid& grid, const Scene& scene, const Field& f_s_cell, const Field& alpha);
};

}  // namespace granvof
