// The friction coefficients of (17) that model.friction_law chooses from. The first is the paper's. Each is
//   coefficient(ShearedContacts, Solid, Contact) -> [-].
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/closures/friction/constant.hpp"
#include "solver/closures/friction/inertial.hpp"
#include "solver/closures/friction/viscous.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct FrictionLaws : Choices<FrictionConstant, FrictionInertial, FrictionViscous> {};

inline bool depends_on_pore_viscosity(FrictionLaw chosen) {
  return chosen.with([](auto law) { return law.depends_on_pore_viscosity; });
}

}  // namespace granvof::closures
