// Friction coefficient mu(I_v) of grains that a viscous liquid stops, rho_s d_s^2 gamma / mu_c < 1: F. Boyer,
// E. Guazzelli and O. Pouliquen, PRL 107 (2011) 188301, the part of contacts.
//
// mu = mu_s + (mu_2 - mu_s) / (1 + I_v0 / I_v), I_v = mu_c gamma / P, gamma = 2 ||S||; 0.32, 0.7, 0.005 in
// theirs.
#pragma once

#include "solver/closures/friction/sheared_contacts.hpp"
#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct FrictionViscous {
  static constexpr ClosureFacts facts{
      "viscous", "Boyer et al. (2011)", {"contact.fast_friction", "contact.viscous_number"}};
  static constexpr bool depends_on_pore_viscosity = true;

  // [-], SI units. Limits: mu_s for strain_norm -> 0, mu_2 for pressure -> 0.
  static double coefficient(const ShearedContacts& at, const Solid& solid, const Contact& contact) {
    return friction_between(solid.friction, contact.fast_friction, 2.0 * at.strain_norm * at.pore_viscosity,
                            contact.viscous_number * at.pressure);
  }
};

}  // namespace granvof::closures
