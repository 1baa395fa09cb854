// Drag of one bead, eqs (8) and (9), written independently of the closure that both programs use: the oracle
// of their tests.
//
// beta / f_s of (8) times the bead's volume gives the coefficient of (u_c - u_s) on one bead [kg/s]: finite
// as f_s -> 0. The printed branches do not meet at f_c = 0.8; they are blended linearly over f_c in [0.78,
// 0.82].
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace demvof::test {

struct PhaseProperties {
  double density = 0.0;    // [kg/m3]
  double viscosity = 0.0;  // [Pa s]
};

// beta / f_s [kg/(m3 s)] of the packed branch.
inline double packed_drag(double f_s, double slip, const PhaseProperties& p, double d) {
  return 150.0 * f_s * p.viscosity / ((1.0 - f_s) * d * d) + 1.75 * p.density * slip / d;
}

// beta / f_s of the dispersed branch: (3/4) C_D f_c^-1.65 rho slip / d, with C_D Re of (9).
inline double dispersed_drag(double f_s, double slip, const PhaseProperties& p, double d) {
  const double re = p.density * slip * d / p.viscosity;
  const double cd_re = 0.4 * re + 24.0 + 6.0 * re / (1.0 + std::sqrt(re));
  return 0.75 * cd_re * p.viscosity / (d * d) * std::pow(1.0 - f_s, -1.65);
}

// Coefficient [kg/s] in one fluid. f_s in [0, 1), slip = |u_c - u_s| >= 0 [m/s], diameter [m].
inline double bead_drag(double f_s, double slip, const PhaseProperties& fluid, double diameter) {
  const double dilute = std::clamp(((1.0 - f_s) - 0.78) / 0.04, 0.0, 1.0);
  double per_solid_volume = 0.0;
  if (dilute > 0.0) per_solid_volume += dilute * dispersed_drag(f_s, slip, fluid, diameter);
  if (dilute < 1.0) per_solid_volume += (1.0 - dilute) * packed_drag(f_s, slip, fluid, diameter);
  return per_solid_volume * std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

// The share alpha of liquid and 1 - alpha of gas.
inline double bead_drag(double f_s, double alpha, double slip, const PhaseProperties& gas,
                        const PhaseProperties& liquid, double diameter) {
  return alpha * bead_drag(f_s, slip, liquid, diameter) + (1.0 - alpha) * bead_drag(f_s, slip, gas, diameter);
}

}  // namespace demvof::test
