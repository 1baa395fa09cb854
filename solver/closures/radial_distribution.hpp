// Radial distribution function at contact, eq (19).
#pragma once

#include <algorithm>

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

}  // namespace granvof::closures
