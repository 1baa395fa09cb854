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

}  // namespace granvof::closures
