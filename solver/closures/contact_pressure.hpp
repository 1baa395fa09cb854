// Pressure of enduring contacts: elastic part (13), dense-flow pressure (15).
// Equations: docs/theory/contact.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/scene/scene.hpp"

namespace granvof::closures {

struct PressureAndSlope {
  double value;  // P [Pa]
  double slope;  // dP / d f_s [Pa]
};

// P_s^ES [Pa], eq (13), with the leading f_s as printed. The argument of the sine is frozen where the printed
// form would fall again, beyond f_s,max. `packing` is the solid fraction at which the grains touch: f_s,min
// in the paper, a state of the bed where shear changes it (shear_dilatancy.hpp), and the law then moves with
// it.
inline PressureAndSlope elastic_pressure(double f_s, const Contact& c, double packing) {
  const double excess = f_s - packing;
  if (excess <= 0.0) return {0.0, 0.0};
  const double width = c.solid_fraction_max - c.solid_fraction_min;
  const double share = excess / width;
  const double angle = (std::min(share, 1.0) - 0.5) * std::numbers::pi;
  const double ramp = 1.0 + std::sin(angle);
  const double ramp_slope = share < 1.0 ? std::cos(angle) * std::numbers::pi / width : 0.0;
  const double power = std::pow(excess, c.exponent);
  const double value = c.stiffness * f_s * power * ramp;
  const double slope =
      c.stiffness * (power * ramp + f_s * (c.exponent * power / excess * ramp + power * ramp_slope));
  return {value, slope};
}

inline PressureAndSlope elastic_pressure(double f_s, const Contact& c) {
  return elastic_pressure(f_s, c, c.solid_fraction_min);
}

inline constexpr double dense_pressure_cap = 0.005;  // least f_s0 - f_s in (15), which is singular at f_s0

// P_s^D [Pa], eq (15): 15 rho_s Theta (1 - e) (a' f_s f_s0 / (f_s0 - f_s))^(2/delta) (corrections of (15)).
// f_s0 moves with `packing` as (13) does: it is the packing of a dense flow that comes to rest. (Left in its
// place, a bed at rest at 0.61 sits on the singularity, and blows up within 5 ms of its release.)
inline PressureAndSlope dense_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                       double packing) {
  if (f_s <= 0.0 || theta <= 0.0) return {0.0, 0.0};
  const double f_s0 = c.dense_solid_fraction + (packing - c.solid_fraction_min);
  const double gap = std::max(f_s0 - f_s, dense_pressure_cap);
  const bool capped = f_s0 - f_s <= dense_pressure_cap;
  const double power = 2.0 / c.flow_law_exponent;
  const double bracket = c.flow_law_factor * f_s * f_s0 / gap;
  const double value = 15.0 * rho_s * theta * (1.0 - e) * std::pow(bracket, power);
  const double log_slope = power * (1.0 / f_s + (capped ? 0.0 : 1.0 / gap));
  return {value, value * log_slope};
}

inline PressureAndSlope dense_pressure(double f_s, double theta, double e, double rho_s, const Contact& c) {
  return dense_pressure(f_s, theta, e, rho_s, c, c.solid_fraction_min);
}

}  // namespace granvof::closures
