// Slope limiters of the bounded second-order fluxes.
#pragma once

namespace granvof {

// van Leer's harmonic limiter: the slope between two differences, 0 at an extremum. Symmetric in a and b.
inline double van_leer(double a, double b) {
  const double product = a * b;
  return product > 0.0 ? 2.0 * product / (a + b) : 0.0;
}

}  // namespace granvof
