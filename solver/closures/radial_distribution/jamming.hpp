// Radial distribution function at contact of spheres up to jamming: S. Chialvo and S. Sundaresan, Phys.
// Fluids 25 (2013) 070603, a fit to sheared spheres by DEM.
//
// g0 = (2 - f_s) / (2 (1 - f_s)^3) + A f_s^2 / (f_s,max - f_s)^(3/2): Carnahan and Starling's of dilute
// spheres, and what they do near jamming at f_s,max (they give f_s,max = 0.636 for smooth grains). With it
// the wall-normal balance of sheared smooth spheres (Vescovi et al., Phys. Fluids 26 (2014) 053305), f Theta
// (1 + 2 (1 + e) f g0) constant, holds to 11 %; with (19) it is off by a factor of 2.9.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/closures/radial_distribution/parameters.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

// A, how fast g0 diverges [-]: 0.58 for smooth grains, more for rubbing ones, mu >= 0 between two grains.
inline double jamming_amplitude(double mu) {
  return 0.58 + 3.12 * std::tanh(mu / 0.54);
}

struct RadialJamming {
  static constexpr ClosureFacts facts{"jamming", "Chialvo and Sundaresan (2013)"};

  // g0 [-], f_s in [0, 1); capped as (19).
  static double value(double f_s, const RadialParameters& p) {
    const double gap = std::max(p.f_max - f_s, radial_distribution_cap * p.f_max), room = 1.0 - f_s;
    return (2.0 - f_s) / (2.0 * room * room * room) + p.amplitude * f_s * f_s / (gap * std::sqrt(gap));
  }

  // d g0 / d f_s [-], the cap included.
  static double slope(double f_s, const RadialParameters& p) {
    const double gap = p.f_max - f_s, least = radial_distribution_cap * p.f_max, room = 1.0 - f_s;
    const double dilute = (5.0 - 2.0 * f_s) / (2.0 * room * room * room * room);
    const double held = std::max(gap, least), root = std::sqrt(held);
    const double dense =
        2.0 * f_s / (held * root) + (gap > least ? 1.5 * f_s * f_s / (held * held * root) : 0.0);
    return dilute + p.amplitude * dense;
  }
};

}  // namespace granvof::closures
