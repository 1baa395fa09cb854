// Critical packing that does not ask how fast it is sheared: M. Pailha and O. Pouliquen, J. Fluid Mech. 633
// (2009) 115.
#pragma once

#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct CriticalPackingConstant {
  static constexpr ClosureFacts facts{"constant", "Pailha and Pouliquen (2009)"};
  static constexpr bool depends_on_rate = false;

  // [-]
  static double packing(double /*mixed_number*/, const Contact& contact) {
    return contact.critical_solid_fraction;
  }
};

}  // namespace granvof::closures
