// Drag on the agitation of grains in dense flow, as a friction coefficient.
//
// Grains that shear past each other fluctuate about their mean velocity by
//   dv = c gamma d_s / sqrt(I),  I = gamma d_s / sqrt(P / rho_s),  c = 1/3
// (da Cruz et al., Phys. Rev. E 72 (2005) 021309, plane shear of dry disks by DEM), whatever friction moves
// them: the granular temperature of (7), which is fed by the kinetic stress alone, knows nothing of it. In a
// fluid this agitation is dragged: beta dv^2 per volume, taken from the shear, is a shear stress beta dv^2 /
// gamma. The beads of demvof follow the same law under water: sqrt(3 Theta) sqrt(I) / (gamma d_s) = 0.29,
// quartiles 0.27 and 0.34, over T = 1 to 8 of s2 (f_s > 0.5, I > 0.02; the shear within a fluid cell taken
// off), where drag takes 5 to 8 % of what the collapse loses that way.
#pragma once

#include <cmath>

namespace granvof::closures {

inline constexpr double agitation_factor = 1.0 / 3.0;  // c
inline constexpr double quasi_static_inertial_number =
    1e-3;  // slower flows fluctuate by a constant times gamma d_s

// What it adds to the friction coefficient [-]: c^2 beta gamma d_s^2 / ((I + I_q) P), gamma = 2 ||S||. drag =
// beta [kg/m3 s], p_enduring > 0 [Pa], strain_norm = ||S|| >= 0 [1/s], SI units. Limits: 0 for strain_norm ->
// 0 (a bed at rest is no stronger); c^2 beta d_s / sqrt(rho_s P) for I >> I_q.
inline double agitation_friction(double drag, double p_enduring, double strain_norm, double rho_s,
                                 double d_s) {
  const double passing = 2.0 * strain_norm * d_s;  // gamma d_s [m/s]
  const double inertial = passing * std::sqrt(rho_s / p_enduring) + quasi_static_inertial_number;
  return agitation_factor * agitation_factor * drag * passing * d_s / (inertial * p_enduring);
}

}  // namespace granvof::closures
