// Coulomb friction of enduring contacts, regularised, eq (17).
#pragma once

#include <cmath>

namespace granvof::closures {

// Viscosity [Pa s] of tau^E = 2 mu S: mu = P_s^E eta (1 - exp(-n ||S||)) / (2 ||S||), ||S|| = sqrt(S:S / 2).
// p_enduring >= 0 [Pa], eta = tan(theta_s) [-], n [s], strain_norm = ||S|| >= 0 [1/s].
// Limit ||S|| -> 0: P_s^E eta n / 2.
inline double friction_viscosity(double p_enduring, double eta, double n, double strain_norm) {
  const double x = n * strain_norm;
  const double shape = x > 1e-8 ? -std::expm1(-x) / x : 1.0 - 0.5 * x;
  return 0.5 * p_enduring * eta * n * shape;
}

// mu_s + (mu_2 - mu_s) / (1 + slow / fast) [-], fast, slow >= 0 in one unit. Limits: mu_s for fast = 0, mu_2
// for slow = 0.
inline double friction_between(double mu_s, double mu_2, double fast, double slow) {
  return fast > 0.0 ? mu_s + (mu_2 - mu_s) * fast / (fast + slow) : mu_s;
}

// Friction coefficient mu(I) = mu_s + (mu_2 - mu_s) / (1 + I_0 / I) [-] of dense flow, I = gamma d_s / sqrt(P
// / rho_s), gamma = 2 ||S|| (Jop, Forterre and Pouliquen, Nature 441 (2006) 727). Under water the same law
// holds while a grain is stopped by others and not by the liquid, rho_s d_s^2 gamma / mu_c > 1 (Cassar et
// al., Phys. Fluids 17 (2005) 103301; Trulsson et al., PRL 109 (2012) 118305): 16 for s1 at 10 1/s. Limits:
// mu_s for strain_norm -> 0, mu_2 for p -> 0. p_enduring >= 0 [Pa], strain_norm = ||S|| >= 0 [1/s], SI units.
inline double inertial_friction(double p_enduring, double strain_norm, double mu_s, double mu_2, double i_0,
                                double rho_s, double d_s) {
  return friction_between(mu_s, mu_2, 2.0 * strain_norm * d_s * std::sqrt(rho_s),
                          i_0 * std::sqrt(p_enduring));
}

// Friction coefficient mu(I_v) [-] of grains that a viscous liquid stops, rho_s d_s^2 gamma / mu_c < 1: mu_s
// + (mu_2 - mu_s) / (1 + I_v0 / I_v), I_v = mu_c gamma / P, gamma = 2 ||S||, the part of contacts (Boyer,
// Guazzelli and Pouliquen, PRL 107 (2011) 188301: 0.32, 0.7, 0.005 in theirs). Limits: mu_s for strain_norm
// -> 0, mu_2 for p -> 0. p_enduring >= 0 [Pa], mu_c >= 0 [Pa s], i_v0 > 0 [-].
inline double viscous_friction(double p_enduring, double strain_norm, double mu_s, double mu_2, double i_v0,
                               double mu_c) {
  return friction_between(mu_s, mu_2, 2.0 * strain_norm * mu_c, i_v0 * p_enduring);
}

// Friction coefficient below which a layer of thickness h [m] on a rough floor comes to rest [-]: mu_s +
// (mu_2 - mu_s) / (1 + h / (L d_s)), the inverse of h_stop(theta) (Pouliquen, Phys. Fluids 11 (1999) 542). L
// = 1.65 belongs to mu_2, I_0 of inertial_friction(): both are fits of the same flows (Jop et al., J. Fluid
// Mech. 541 (2005) 167). Limits: mu_2 for h -> 0, mu_s for a thick bed. h >= 0, length = L > 0 [-].
inline double arrest_friction(double h, double mu_s, double mu_2, double length, double d_s) {
  return mu_s + (mu_2 - mu_s) / (1.0 + h / (length * d_s));
}

}  // namespace granvof::closures
