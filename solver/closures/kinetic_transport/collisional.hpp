// What collisions hand over of momentum and heat: (20) and (22).
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

// kappa_s^K / mu_s^K of (20) and (22); the flux uses f_s kappa_s^K (correction of (22)).
inline constexpr double conductivity_to_viscosity = 5.0 / 2.0;

struct TransportCollisional {
  static constexpr ClosureFacts facts{"collisional", "(20), (22)"};

  // mu_s^K over that of (20) [-].
  static double viscosity(double /*f_s*/, double /*e*/, double /*g0*/) { return 1.0; }

  // kappa_s^K / mu_s^K [-].
  static double conductivity(double /*f_s*/, double /*e*/, double /*g0*/) {
    return conductivity_to_viscosity;
  }
};

}  // namespace granvof::closures
