// Sub-grid viscosity of the continuous phase (Smagorinsky), eq (10).
// Equations: docs/theory/balances.md.
#pragma once

#include <cmath>

namespace granvof::closures {

inline constexpr double smagorinsky_constant = 0.18;  // C_s [-]

// mu_t [Pa s] = rho_c (C_s Delta)^2 sqrt(2 S:S), S = (grad u + grad u^T)/2. That is (10) with the printed |S|
// read as grad u + grad u^T (correction of (10)). Delta is the cell size [m], strain_squared = S:S [1/s2].
inline double eddy_viscosity(double rho_c, double delta, double strain_squared) {
  const double length = smagorinsky_constant * delta;
  return rho_c * length * length * std::sqrt(2.0 * strain_squared);
}

}  // namespace granvof::closures
