// Friction coefficient mu(I) of dense flow: P. Jop, Y. Forterre and O. Pouliquen, Nature 441 (2006) 727.
//
// mu = mu_s + (mu_2 - mu_s) / (1 + I_0 / I), I = gamma d_s / sqrt(P / rho_s), gamma = 2 ||S||. Under water
// the same law holds while a grain is stopped by others and not by the liquid, rho_s d_s^2 gamma / mu_c > 1
// (Cassar et al., Phys. Fluids 17 (2005) 103301; Trulsson et al., PRL 109 (2012) 118305): 16 for s1 at 10
// 1/s.
#pragma once

#include <cmath>

#include "solver/closures/friction/sheared_contacts.hpp"
#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct FrictionInertial {
  static constexpr ClosureFacts facts{
      "inertial", "Jop et al. (2006)", {"contact.fast_friction", "contact.inertial_number"}};
  static constexpr bool depends_on_pore_viscosity = false;

  // [-], SI units. Limits: mu_s for strain_norm -> 0, mu_2 for pressure -> 0.
  static double coefficient(const ShearedContacts& at, const Solid& solid, const Contact& contact) {
    return friction_between(solid.friction, contact.fast_friction,
                            2.0 * at.strain_norm * solid.diameter * std::sqrt(solid.density),
                            contact.inertial_number * std::sqrt(at.pressure));
  }
};

}  // namespace granvof::closures
