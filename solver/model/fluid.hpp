// A fluid of a scene.
#pragma once

namespace granvof {

struct Fluid {
  double density = 0.0;    // rho_g, rho_l [kg/m3], > 0
  double viscosity = 0.0;  // mu_g, mu_l [Pa s], >= 0
  bool operator==(const Fluid&) const = default;
};

}  // namespace granvof
