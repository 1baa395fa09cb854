// Grains touch at the packing of their bed, which they carry along: where (13) bears what lies on them at the
// start. Own.
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/model/choices.hpp"
#include "solver/model/grains.hpp"

namespace granvof::closures {

struct PackingCarried {
  static constexpr ClosureFacts facts{"carried", "own"};
  static constexpr bool is_carried = true;

  // [-]
  template <typename Bears>
  static double at_start(const Bears& bears, const Contact& /*contact*/) {
    return bears();
  }
};

}  // namespace granvof::closures
