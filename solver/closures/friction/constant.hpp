// Friction coefficient of (17): eta_s = tan(theta_s), at any rate of shear.
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/closures/friction/sheared_contacts.hpp"
#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct FrictionConstant {
  static constexpr ClosureFacts facts{"constant", "the paper's (17)"};
  static constexpr bool depends_on_pore_viscosity = false;

  // [-]
  static double coefficient(const ShearedContacts&, const Solid& solid, const Contact&) {
    return solid.friction;
  }
};

}  // namespace granvof::closures
