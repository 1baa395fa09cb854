// Critical packing that falls with the rate of shear, f_c / (1 + a sqrt(J)): without inertia and with a = 1
// that which F. Boyer, E. Guazzelli and O. Pouliquen, PRL 107 (2011) 188301, measured in suspensions.
#pragma once

#include <cmath>

#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct CriticalPackingByRate {
  static constexpr ClosureFacts facts{"by-rate", "Boyer et al. (2011)", {"contact.dilatancy_rate"}};
  static constexpr bool depends_on_rate = true;

  // [-]; J = mixed_number >= 0 of shear_dilatancy.hpp. Limits: f_c for slow shear.
  static double packing(double mixed_number, const Contact& contact) {
    return contact.critical_solid_fraction / (1.0 + contact.loosening_factor * std::sqrt(mixed_number));
  }
};

}  // namespace granvof::closures
