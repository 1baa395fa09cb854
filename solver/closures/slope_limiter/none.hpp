// First order: a face carries what lies upwind of it, the paper's.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct LimiterNone {
  static constexpr ClosureFacts facts{"upwind", "first order, the paper's"};
  static constexpr bool second_order = false;

  static double slope(double /*a*/, double /*b*/) { return 0.0; }
};

}  // namespace granvof::closures
