// Kinetic theory of the grains: pressure (11), viscosities (20), (21), dissipation (23). Conductivity (22) is
// in kinetic_transport/.
//
// All take f_s in [0, f_s,max], Theta >= 0 [m2/s2], e in [0, 1], the caller's g0 (eq (19)), and SI units.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <cmath>
#include <numbers>

namespace granvof::closures {

// P_s^K [Pa], eq (11).
inline double kinetic_pressure(double f_s, double theta, double e, double g0, double rho_s) {
  return rho_s * f_s * theta * (1.0 + 2.0 * (1.0 + e) * f_s * g0);
}

// mu_s^K [Pa s], eq (20). The stress (16) uses f_s mu_s^K.
inline double kinetic_viscosity(double f_s, double theta, double e, double g0, double rho_s, double d_s) {
  return 0.8 * rho_s * d_s * f_s * g0 * (1.0 + e) * std::sqrt(theta) * std::numbers::inv_sqrtpi;
}

inline constexpr double bulk_to_shear_viscosity = 5.0 / 3.0;  // zeta_s^K / mu_s^K, eqs (20), (21)

// gamma_s^K / Theta^(3/2) [kg/m4] of eq (23), of grains that keep their distances.
inline double collisional_dissipation_rate(double f_s, double e, double g0, double rho_s, double d_s) {
  return 12.0 * (1.0 - e * e) * f_s * f_s * rho_s * g0 * std::numbers::inv_sqrtpi / d_s;
}

// The other part over Theta [kg/m s3]: grains that move apart collide less. div_u_s = div u_s [1/s].
inline double expansion_dissipation_rate(double f_s, double e, double g0, double rho_s, double div_u_s) {
  return -3.0 * (1.0 - e * e) * f_s * f_s * rho_s * g0 * div_u_s;
}

// The positive root w of a w^2 + b w = c; a >= 0, c >= 0, not both a and b zero. Written so that nothing
// cancels: w = 2c / (b + sqrt(b^2 + 4ac)) for b >= 0. Returns 0 where c = 0 and b >= 0.
inline double positive_root(double a, double b, double c) {
  const double root = std::sqrt(b * b + 4.0 * a * c);
  if (b >= 0.0) return b + root > 0.0 ? 2.0 * c / (b + root) : 0.0;
  return a > 0.0 ? (root - b) / (2.0 * a) : 0.0;
}

// The positive root w of a w^3 + b w^2 = c; a >= 0, b >= 0, c >= 0, not both a and b zero; 0 where c = 0. To
// rounding: convex and rising, so that Newton comes down from any w above the root.
inline double cubic_root(double a, double b, double c) {
  if (c <= 0.0) return 0.0;
  double w = b > 0.0 ? std::sqrt(c / b) : std::cbrt(c / a);
  if (a * w > b) w = std::cbrt(c / a);
  constexpr int most = 30;
  for (int k = 0; k < most; ++k) {
    const double next = w - (w * w * (a * w + b) - c) / (w * (3.0 * a * w + 2.0 * b));
    const bool arrived = next >= w * (1.0 - 1e-15);
    w = next;
    if (arrived) break;
  }
  return w;
}

}  // namespace granvof::closures
