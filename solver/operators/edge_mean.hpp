// Viscosity on an edge of the staggered grid.
#pragma once

#include <cstddef>

namespace granvof {

// Harmonic mean of the four cells around edge c of the plane with strides s and t: gas beside liquid must not
// feel the liquid's viscosity. Values >= 0; 0 where a whole side of the edge is 0.
inline double edge_mean(const double* mu, std::ptrdiff_t c, std::ptrdiff_t s, std::ptrdiff_t t) {
  const double a = mu[c] * mu[c - s], b = mu[c - t] * mu[c - s - t];
  const double sum = (mu[c] + mu[c - s]) * b + (mu[c - t] + mu[c - s - t]) * a;
  return sum > 0.0 ? 4.0 * a * b / sum : 0.0;
}

}  // namespace granvof
