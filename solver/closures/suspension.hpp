// Dense grains that a viscous liquid shears past each other: pressure of their contacts, viscosity of the
// liquid between them.
#pragma once

#include <algorithm>

#include "solver/closures/contact_pressure.hpp"

namespace granvof::closures {

inline constexpr double suspension_cap = 0.02;  // least 1 - f_s / f_s,max: both diverge at f_s,max

// P_v [Pa] = (f_s / (f_s,max - f_s))^2 mu_c gamma: the inverse of f_s = f_s,max / (1 + sqrt(I_v)), I_v = mu_c
// gamma / P (Boyer, Guazzelli and Pouliquen, PRL 107 (2011) 188301). f_s in [0, 1), viscous_stress = mu_c
// gamma >= 0 [Pa]. Limits: 0 at rest, and for dilute grains.
inline PressureAndSlope viscous_contact_pressure(double f_s, double f_s_max, double viscous_stress) {
  const double least = suspension_cap * f_s_max, gap = f_s_max - f_s, held = std::max(gap, least);
  const double share = f_s / held;
  return {share * share * viscous_stress,
          2.0 * share * viscous_stress * (gap > least ? f_s_max / (held * held) : 1.0 / held)};
}

// Viscosity of the liquid among grains over that of the liquid alone [-], (1 + 5/2 f_s / (1 - f_s / f_s,max))
// / (1 - f_s): with the share 1 - f_s of the fluid's stress this is Boyer et al.'s, less their contacts. f_s
// in [0, 1). Limits: Einstein's 1 + 5/2 f_s, per share of the fluid, for f_s -> 0.
inline double suspension_viscosity(double f_s, double f_s_max) {
  return (1.0 + 2.5 * f_s / std::max(1.0 - f_s / f_s_max, suspension_cap)) / (1.0 - f_s);
}

}  // namespace granvof::closures
