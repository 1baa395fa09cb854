// Radial distribution function at contact, eq (19), and that of spheres up to jamming.
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof::closures {

inline constexpr double radial_distribution_cap = 0.02;  // least 1 - f_s / f_s,max

// g0 [-] = (1 - 7 f_s / 16) / (1 - f_s / f_s,max)^2, f_s >= 0; capped near f_s,max, where it diverges.
inline double radial_distribution(double f_s, double f_s_max) {
  const double gap = std::max(1.0 - f_s / f_s_max, radial_distribution_cap);
  return (1.0 - 7.0 / 16.0 * f_s) / (gap * gap);
}

// d g0 / d f_s [-], the cap included.
inline double radial_distribution_slope(double f_s, double f_s_max) {
  const double gap = 1.0 - f_s / f_s_max;
  if (gap <= radial_distribution_cap)
    return -7.0 / 16.0 / (radial_distribution_cap * radial_distribution_cap);
  return (-7.0 / 16.0 + 2.0 * (1.0 - 7.0 / 16.0 * f_s) / (gap * f_s_max)) / (gap * gap);
}

// How fast g0 of jamming spheres diverges [-]: 0.58 for smooth grains, more for rubbing ones, mu >= 0 between
// two grains (Chialvo and Sundaresan, Phys. Fluids 25 (2013) 070603, a fit to sheared spheres by DEM).
inline double jamming_amplitude(double mu) {
  return 0.58 + 3.12 * std::tanh(mu / 0.54);
}

// g0 [-] = (2 - f_s) / (2 (1 - f_s)^3) + A f_s^2 / (f_s,max - f_s)^(3/2), f_s in [0, 1): Carnahan and
// Starling's of dilute spheres, and what they do near jamming at f_s,max (Chialvo and Sundaresan 2013; they
// give f_s,max = 0.636 for smooth grains). `amplitude`: A. With it the wall-normal balance of sheared smooth
// spheres (Vescovi et al., Phys. Fluids 26 (2014) 053305), f Theta (1 + 2 (1 + e) f g0) constant, holds to
// 11 %; with (19) it is off by a factor of 2.9. Capped as (19).
inline double radial_distribution_jamming(double f_s, double f_s_max, double amplitude) {
  const double gap = std::max(f_s_max - f_s, radial_distribution_cap * f_s_max), room = 1.0 - f_s;
  return (2.0 - f_s) / (2.0 * room * room * room) + amplitude * f_s * f_s / (gap * std::sqrt(gap));
}

// d g0 / d f_s [-] of it, the cap included.
inline double radial_distribution_jamming_slope(double f_s, double f_s_max, double amplitude) {
  const double gap = f_s_max - f_s, least = radial_distribution_cap * f_s_max, room = 1.0 - f_s;
  const double dilute = (5.0 - 2.0 * f_s) / (2.0 * room * room * room * room);
  const double held = std::max(gap, least), root = std::sqrt(held);
  const double dense =
      2.0 * f_s / (held * root) + (gap > least ? 1.5 * f_s * f_s / (held * held * root) : 0.0);
  return dilute + amplitude * dense;
}

}  // namespace granvof::closures
