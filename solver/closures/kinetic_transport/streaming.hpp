// What grains carry as they fly beside what collisions hand over: M. Syamlal, W. Rogers and T. J. O'Brien,
// MFIX Documentation (1993).
//
//   f_s mu_s^K / (rho_s d_s sqrt(Theta)) = 4/5 f^2 g0 (1 + e) / sqrt(pi) + sqrt(pi) f^2 g0 (1 + e) (3e - 1) /
//       (15 (3 - e)) + sqrt(pi) f / (6 (3 - e)),
//   f_s kappa_s^K / (rho_s d_s sqrt(Theta)) = 2 f^2 g0 (1 + e) / sqrt(pi) +
//       [9/32 (1 + e)^2 (2e - 1) f^2 g0 + 15/32 f] sqrt(pi) / ((49 - 33 e) / 16);
// the first terms are (20) and (22), and neither is let fall below those, which the second terms do for
// inelastic grains. Limits: both grow as 1 / (f_s g0) for dilute grains, so that f_s mu_s^K vanishes as f_s
// and not as f_s^2.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include <algorithm>
#include <numbers>

#include "solver/closures/kinetic_transport/collisional.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

struct TransportWithStreaming {
  static constexpr ClosureFacts facts{"with-streaming", "Syamlal et al. (1993)"};

  // mu_s^K over that of (20) [-]; f_s > 0, e in [0, 1].
  static double viscosity(double f_s, double e, double g0) {
    constexpr double pi = std::numbers::pi;
    const double own = 5.0 * pi / (4.0 * (1.0 + e) * (3.0 - e));  // over the first term
    return 1.0 + own * std::max((1.0 + e) * (3.0 * e - 1.0) / 15.0 + 1.0 / (6.0 * f_s * g0), 0.0);
  }

  // kappa_s^K / mu_s^K [-], streaming in both.
  static double conductivity(double f_s, double e, double g0) {
    constexpr double pi = std::numbers::pi;
    const double own = pi / (2.0 * (1.0 + e)) * 16.0 / (49.0 - 33.0 * e);  // over the first term
    const double flown = 9.0 / 32.0 * (1.0 + e) * (1.0 + e) * (2.0 * e - 1.0) + 15.0 / (32.0 * f_s * g0);
    return conductivity_to_viscosity * (1.0 + own * std::max(flown, 0.0)) / viscosity(f_s, e, g0);
  }
};

}  // namespace granvof::closures
