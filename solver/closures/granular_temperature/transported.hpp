// Theta by all of (7): carried with the grains, conducted, made and lost.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct TemperatureTransported {
  static constexpr ClosureFacts facts{"transported", "(7)"};
  static constexpr bool agitates = true, is_transported = true;
};

}  // namespace granvof::closures
