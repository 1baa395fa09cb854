// Loops over rows whose bodies know at compile time which directions are coupled.
#pragma once

#include <array>

namespace granvof::linear {

// Calls visit.template operator()<X, Y, Z>() for the coupled directions given at run time.
template <typename Visit>
inline decltype(auto) with_directions(const std::array<bool, 3>& coupled, Visit&& visit) {
  switch ((coupled[0] ? 1 : 0) + (coupled[1] ? 2 : 0) + (coupled[2] ? 4 : 0)) {
    case 1:
      return visit.template operator()<true, false, false>();
    case 2:
      return visit.template operator()<false, true, false>();
    case 3:
      return visit.template operator()<true, true, false>();
    case 4:
      return visit.template operator()<false, false, true>();
    case 5:
      return visit.template operator()<true, false, true>();
    case 6:
      return visit.template operator()<false, true, true>();
    case 7:
      return visit.template operator()<true, true, true>();
    default:
      return visit.template operator()<false, false, false>();
  }
}

}  // namespace granvof::linear
