// Collisions of grains with a wall that grains are glued to, in a regular array: they slip, and heat the
// flow.
//
// A grain meets a bump at any angle to the wall's normal up to psi, sin(psi) = (d_s + gap) / (2 d_s), evenly
// over that cap of directions; a bump does not move. With Maxwellian velocities about the mean, relative to
// the wall u along it, to first order in u / sqrt(Theta), integrals over the cap give the tangential stress s
// of the collisions that make up the normal one, p:
//   s / p = (2 / 3) sqrt(2 / pi) (1 - cos psi)(2 + cos psi) / (1 + cos psi) u / sqrt(Theta).
// This is Richman, Acta Mech. 75 (1988) 227, without his terms of the strain rate at the wall (derived anew:
// the paper was not at hand). The flow gains s u, and loses to the bumps what Johnson and Jackson, J. Fluid
// Mech. 176 (1987) 67, count,
//   D = sqrt(3) pi / 4 (1 - e_w^2) f_s / f_s,max rho_s g0 Theta^(3/2).
// The loss of the same integrals, sqrt(2 / pi) 2 / (1 + cos psi) (1 - e_w) p sqrt(Theta), is a third of it
// for e_w = 0.7, and walls of sheared spheres take more than that (Vescovi et al., Phys. Fluids 26 (2014)
// 053305, from whose profiles 0.8 p sqrt(Theta) is read: D is 0.85 there, the integrals give 0.27).
#pragma once

#include <cmath>
#include <numbers>

namespace granvof::closures {

// u / ((s / p) sqrt(Theta)) [-] for psi in (0, pi / 2]. Limits: infinite for psi -> 0, a smooth wall; 0.94
// for pi / 2.
inline double bumpy_wall_slip(double psi) {
  const double c = std::cos(psi);
  return 1.5 * std::sqrt(0.5 * std::numbers::pi) * (1.0 + c) / ((1.0 - c) * (2.0 + c));
}

// D / (f_s / f_s,max rho_s g0 Theta^(3/2)) [-] for e_w in [0, 1]. Limits: 0 for elastic bumps.
inline double bumpy_wall_loss(double e_w) {
  return 0.25 * std::numbers::sqrt3 * std::numbers::pi * (1.0 - e_w * e_w);
}

}  // namespace granvof::closures
