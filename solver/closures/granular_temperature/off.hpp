// No Theta, and with it no kinetic stress.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct TemperatureOff {
  static constexpr ClosureFacts facts{"off", "none"};
  static constexpr bool agitates = false, is_transported = false;
};

}  // namespace granvof::closures
