// Radial distribution function at contact, eq (19).
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <algorithm>

#include "solver/closures/radial_distribution/parameters.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

struct RadialPaper {
  static constexpr ClosureFacts facts{"paper", "(19)"};

  // g0 [-] = (1 - 7 f_s / 16) / (1 - f_s / f_s,max)^2, f_s >= 0; capped near f_s,max, where it diverges.
  static double value(double f_s, const RadialParameters& p) {
    const double gap = std::max(1.0 - f_s / p.f_max, radial_distribution_cap);
    return (1.0 - 7.0 / 16.0 * f_s) / (gap * gap);
  }

  // d g0 / d f_s [-], the cap included.
  static double slope(double f_s, const RadialParameters& p) {
    const double gap = 1.0 - f_s / p.f_max;
    if (gap <= radial_distribution_cap)
      return -7.0 / 16.0 / (radial_distribution_cap * radial_distribution_cap);
    return (-7.0 / 16.0 + 2.0 * (1.0 - 7.0 / 16.0 * f_s) / (gap * p.f_max)) / (gap * gap);
  }
};

}  // namespace granvof::closures
