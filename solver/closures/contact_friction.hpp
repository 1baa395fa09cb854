// Coulomb friction of enduring contacts, regularised, eq (17).
// Equations: docs/theory/contact.md.
#pragma once

#include <algorithm>
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

// Viscosity f_s mu_s^K [Pa s] of grains whose friction law is one of their whole stress, contacts and
// collisions: these bear P_s^K and shear by no more than the law has for that, so that both together never
// shear by more than eta (P_s^E + P_s^K). kinetic = f_s mu_s^K of kinetic theory >= 0 [Pa s], p_kinetic =
// P_s^K >= 0 [Pa], eta of P_s^E + P_s^K; the rest as in friction_viscosity(). Own. Limits: kinetic for
// ||S|| -> 0, and of a gas that is hot for its shear; 0 for P_s^K = 0 or eta = 0.
inline double bounded_kinetic_viscosity(double kinetic, double p_kinetic, double eta, double n,
                                        double strain_norm) {
  return std::min(kinetic, friction_viscosity(p_kinetic, eta, n, strain_norm));
}

// Friction coefficient below which a layer of thickness h [m] on a rough floor comes to rest [-]: mu_s +
// (mu_2 - mu_s) / (1 + h / (L d_s)), the inverse of h_stop(theta) (Pouliquen, Phys. Fluids 11 (1999) 542). L
// = 1.65 belongs to mu_2, I_0 of FrictionInertial: both are fits of the same flows (Jop et al., J. Fluid
// Mech. 541 (2005) 167). Limits: mu_2 for h -> 0, mu_s for a thick bed. h >= 0, length = L > 0 [-].
inline double arrest_friction(double h, double mu_s, double mu_2, double length, double d_s) {
  return mu_s + (mu_2 - mu_s) / (1.0 + h / (length * d_s));
}

}  // namespace granvof::closures
