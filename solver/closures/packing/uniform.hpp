// Grains touch at f_s,min everywhere and always: the paper's.
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct PackingUniform {
  static constexpr ClosureFacts facts{"uniform", "(13)"};
  static constexpr bool is_carried = false;

  // [-]
  template <typename Bears>
  static double at_start(const Bears& /*bears*/, const Contact& contact) {
    return contact.solid_fraction_min;
  }
};

}  // namespace granvof::closures
