// Restitution coefficient of grains that collide: in a liquid, eq (18), and with friction.
// Equations: docs/theory/kinetic-theory.md.
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

// e0 of frictional grains [-]: what collisions of rubbing spheres dissipate, as smooth ones of this
// restitution would, e - 3/2 mu exp(-3 mu), not below 0 (Chialvo and Sundaresan, Phys. Fluids 25 (2013)
// 070603, a fit to sheared frictional spheres by DEM, mu to 0.5 and more; formula as remembered, the paper
// was not at hand). e in [0, 1], mu >= 0 between two grains. Limits: e for mu -> 0.
inline double frictional_restitution(double e, double mu) {
  return std::max(e - 1.5 * mu * std::exp(-3.0 * mu), 0.0);
}

}  // namespace granvof::closures
