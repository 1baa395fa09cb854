// Restitution coefficient of grains that collide in a liquid, eq (18).
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof::closures {

// e = e0 - 2.85 St^(-1/2), St = rho_s d_s sqrt(Theta) / (18 mu_c) (the printed Theta is not dimensionless),
// kept in [0, e0]: it would run to minus infinity as Theta -> 0. theta >= 0 [m2/s2], mu_c >= 0 [Pa s] of the
// continuous phase around the grains.
inline double effective_restitution(double e0, double theta, double rho_s, double d_s, double mu_c) {
  const double stokes_times_18mu = rho_s * d_s * std::sqrt(theta);
  if (mu_c <= 0.0) return e0;
  if (stokes_times_18mu <= 0.0) return 0.0;
  return std::clamp(e0 - 2.85 * std::sqrt(18.0 * mu_c / stokes_times_18mu), 0.0, e0);
}

}  // namespace granvof::closures
