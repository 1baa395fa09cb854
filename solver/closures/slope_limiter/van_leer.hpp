// van Leer's harmonic limiter (J. Comput. Phys. 14 (1974) 361).
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct LimiterVanLeer {
  static constexpr ClosureFacts facts{"limited", "van Leer (1974)"};
  static constexpr bool second_order = true;

  static double slope(double a, double b) {
    const double product = a * b;
    return product > 0.0 ? 2.0 * product / (a + b) : 0.0;
  }
};

}  // namespace granvof::closures
