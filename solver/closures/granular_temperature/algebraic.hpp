// Theta in steady balance in every cell by itself: what of (7) makes it equals what takes it.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct TemperatureAlgebraic {
  static constexpr ClosureFacts facts{"algebraic", "(7) as production = dissipation"};
  static constexpr bool agitates = true, is_transported = false;
};

}  // namespace granvof::closures
