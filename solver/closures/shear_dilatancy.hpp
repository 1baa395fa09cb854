// Packing of a bed under slow shear: a dense one dilates, a loose one compacts, both to the critical packing.
//
// The paper's contact pressure (13) is elastic: grains touch at f_s,min whatever happened to them. In a real
// bed the solid fraction f_p at which they touch is a matter of history. Under slow shear it follows
//   d f_p / d gamma = -f_p tan(psi),  tan(psi) = K_psi (f_p - f_c),
// and the angle psi adds to friction: eta_s + tan(psi) (Roux and Radjai, Physics of Dry Granular Media (1998)
// 229; Pailha and Pouliquen, J. Fluid Mech. 633 (2009) 115, their K_3 = 4.09 and f_c = 0.582 for glass
// beads). That f_p is a transported state behind an elastic pressure, so that pore fluid has to flow in or
// out, is as in Montella et al., J. Fluid Mech. 925 (2021) A13; there dilatancy acts by that pressure alone.
// The fall of the packing with the rate of shear is P_s^D (15), which stays, or, in viscous liquids too, that
// of f_c itself: critical_packing/by_rate.hpp.
// Equations: docs/theory/contact.md.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/closures/contact_pressure.hpp"

namespace granvof::closures {

// J [-] = I_v + I^2 / 2, I = gamma d_s sqrt(rho_s / P), I_v = mu_c gamma / P: rate of shear over that of
// rearrangement, by viscosity and inertia together (Trulsson, Andreotti and Claudin, PRL 109 (2012) 118305;
// the 1/2 of Amarsid et al., Phys. Rev. E 96 (2017) 012901). gamma >= 0 [1/s], pressure > 0 [Pa], mu_c >= 0
// [Pa s], SI units.
inline double mixed_inertial_number(double gamma, double pressure, double rho_s, double d_s, double mu_c) {
  return (mu_c * gamma + 0.5 * rho_s * d_s * d_s * gamma * gamma) / pressure;
}

inline constexpr double largest_dilatancy_tangent = 0.5;  // at most (Montella et al. 2021)

// The nearest packing to `critical` that a packing f_p is driven to no faster than that [-]: where next to
// nothing holds a bed together, J is large and says no more than that it dilates.
inline double bounded_critical_packing(double critical, double packing, const Contact& c) {
  const double most = largest_dilatancy_tangent / c.dilatancy_slope;
  return std::clamp(critical, packing - most, packing + most);
}

// tan(psi) [-] of a packing f_p [-]; > 0: dilates.
inline double dilatancy_tangent(double packing, const Contact& c) {
  return c.dilatancy_slope * (packing - c.critical_solid_fraction);
}

// f_p after a shear strain gamma >= 0 [-] at constant f_c, K_psi: exact. Limits: `packing` at 0, f_c at
// infinity.
inline double sheared_packing(double packing, double gamma, double f_c, const Contact& c) {
  const double off = (1.0 - f_c / packing) * std::exp(-c.dilatancy_slope * f_c * gamma);
  return f_c / (1.0 - off);
}

inline double sheared_packing(double packing, double gamma, const Contact& c) {
  return sheared_packing(packing, gamma, c.critical_solid_fraction, c);
}

// f_p [-] of a bed that bears `pressure` >= 0 [Pa] at f_s > f_s,min by (13), not below f_s,min: a pressure
// too large for it is not borne in full. To 1e-12.
inline double packing_that_bears(double pressure, double f_s, const Contact& c) {
  double borne = c.solid_fraction_min, free = f_s;
  while (free - borne > 1e-12) {
    const double middle = 0.5 * (borne + free);
    (elastic_pressure(f_s, c, middle).value > pressure ? borne : free) = middle;
  }
  return borne;
}

}  // namespace granvof::closures
