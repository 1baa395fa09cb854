// Drag on the agitation of grains in dense flow, as a friction coefficient.
//
// Grains that shear past each other fluctuate about their mean velocity by
//   dv = c gamma d_s / sqrt(I),  I = gamma d_s / sqrt(P / rho_s),  c = 1/3
// (da Cruz et al., Phys. Rev. E 72 (2005) 021309, plane shear of dry disks by DEM), whatever friction moves
// them: the granular temperature of (7), which is fed by the kinetic stress alone, knows nothing of it. In a
// fluid this agitation is dragged: beta dv^2 per volume, taken from the shear, is a shear stress beta dv^2 /
// gamma. The beads of demvof follow the same law: c = 0.30 in s2 (quartiles 0.26 and 0.34 over 1690 cells and
// T = 1 to 8), 0.33 in the canary (0.28, 0.37), 0.38 in the canary in air (0.30, 0.45), from the Theta of
// their fluid cells with f_s > 0.5 and I > 0.02, the shear within a cell taken off. In s2 drag takes 5 to 10
// % of all that is lost that way. (c = 1/3 as remembered: the paper was not at hand.)
//
// A rearrangement takes d_s sqrt(rho_s / P) and stirs grains anew: drag cannot take more than their energy in
// that time. With this bound it adds at most c^2 f_s = 0.06 to the friction coefficient, in viscous liquids
// too, where grains stop between rearrangements; in s2 it bears on loads below 30 Pa.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof::closures {

inline constexpr double agitation_factor = 1.0 / 3.0;  // c
inline constexpr double quasi_static_inertial_number =
    1e-3;  // slower flows fluctuate by a constant times gamma d_s

// beta [kg/m3 s] as far as agitation can feed it: at most f_s sqrt(rho_s P) / d_s. p_enduring >= 0 [Pa].
inline double agitated_drag(double drag, double f_s, double p_enduring, double rho_s, double d_s) {
  return std::min(drag, f_s * std::sqrt(rho_s * p_enduring) / d_s);
}

// What it adds to the friction coefficient [-]: c^2 beta gamma d_s^2 / ((I + I_q) P), gamma = 2 ||S||. drag
// as agitated_drag() has it [kg/m3 s], p_enduring > 0 [Pa], strain_norm = ||S|| >= 0 [1/s], SI units. Limits:
// 0 for strain_norm -> 0 (a bed at rest is no stronger); c^2 beta d_s / sqrt(rho_s P) for I >> I_q.
inline double agitation_friction(double drag, double p_enduring, double strain_norm, double rho_s,
                                 double d_s) {
  const double passing = 2.0 * strain_norm * d_s;  // gamma d_s [m/s]
  const double inertial = passing * std::sqrt(rho_s / p_enduring) + quasi_static_inertial_number;
  return agitation_factor * agitation_factor * drag * passing * d_s / (inertial * p_enduring);
}

}  // namespace granvof::closures
