// Roe's superbee (Lectures in Applied Mathematics 22 (1985) 163), the steepest slope that makes no new
// extremum: a step stays a step over about two cells, and a smooth hump grows corners.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/model/choices.hpp"

namespace granvof::closures {

struct LimiterSuperbee {
  static constexpr ClosureFacts facts{"compressive", "Roe (1985)"};
  static constexpr bool second_order = true;

  static double slope(double a, double b) {
    if (a * b <= 0.0) return 0.0;
    const double x = std::fabs(a), y = std::fabs(b);
    return std::copysign(std::max(std::min(2.0 * x, y), std::min(x, 2.0 * y)), a);
  }
};

}  // namespace granvof::closures
