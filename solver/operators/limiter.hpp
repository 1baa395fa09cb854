// Slope limiters of the bounded second-order fluxes.
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof {

// van Leer's harmonic limiter: the slope between two differences, 0 at an extremum. Symmetric in a and b.
inline double van_leer(double a, double b) {
  const double product = a * b;
  return product > 0.0 ? 2.0 * product / (a + b) : 0.0;
}

// Roe's superbee (Lectures in Applied Mathematics 22 (1985) 163), the steepest slope that makes no new
// extremum: a step stays a step over about two cells, and a smooth hump grows corners. 0 at an extremum;
// symmetric in a and b.
inline double superbee(double a, double b) {
  if (a * b <= 0.0) return 0.0;
  const double x = std::fabs(a), y = std::fabs(b);
  return std::copysign(std::max(std::min(2.0 * x, y), std::min(x, 2.0 * y)), a);
}

}  // namespace granvof
