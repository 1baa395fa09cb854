// Viscosity on an edge of the staggered grid.
#pragma once

#include <cstddef>

#include "solver/grid/obstacles.hpp"

namespace granvof {

// Harmonic mean of the four cells around edge c of the plane with strides s and t: gas beside liquid must not
// feel the liquid's viscosity. Values >= 0; 0 where a whole side of the edge is 0.
inline double edge_mean(const double* mu, std::ptrdiff_t c, std::ptrdiff_t s, std::ptrdiff_t t) {
  const double a = mu[c] * mu[c - s], b = mu[c - t] * mu[c - s - t];
  const double sum = (mu[c] + mu[c - s]) * b + (mu[c - t] + mu[c - s - t]) * a;
  return sum > 0.0 ? 4.0 * a * b / sum : 0.0;
}

// The same on a flat surface of an obstacle, as if what is beside it went on inside.
inline double edge_mean(const double* mu, const Obstacles::Edge& edge) {
  const double a = mu[edge.open[0]], b = mu[edge.open[1]];
  return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

}  // namespace granvof
