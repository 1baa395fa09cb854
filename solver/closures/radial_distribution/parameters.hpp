// What g0 depends on beside the solid fraction, and how near to contact of all grains it is asked for.
#pragma once

namespace granvof::closures {

inline constexpr double radial_distribution_cap = 0.02;  // least 1 - f_s / f_s,max: g0 diverges at f_s,max

struct RadialParameters {
  double f_max;            // f_s,max [-]
  double amplitude = 0.0;  // of spheres near jamming, jamming_amplitude() [-]
};

}  // namespace granvof::closures
