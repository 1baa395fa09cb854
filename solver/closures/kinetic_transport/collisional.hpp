// What collisions hand over of momentum and heat: (20) and (22).
#pragma once

#include "solver/closures/kinetic_theory.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

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
