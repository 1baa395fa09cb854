// Sums by which a viscous stress on the staggered grid works: its dissipation on edges, and moving walls.
#pragma once

#include "solver/grid/boundary.hpp"

namespace granvof {

// Sum of weight * body(edge) over the edges of plane (d, e). An edge on a side counts half: the stress there
// acts on one row of faces only. Periodic ends count once.
template <typename Body>
double sum_over_edges(const Grid& grid, int d, int e, Body&& body) {
  struct Part {
    int lower, upper;
    double weight;
  };
  const auto parts = [&](int direction) {
    const int n = grid.cells.n[direction];
    if (grid.cells.periodic[direction]) return std::array<Part, 3>{{{0, n, 1.0}, {0, 0, 0.0}, {0, 0, 0.0}}};
    return std::array<Part, 3>{{{0, 1, 0.5}, {1, n, 1.0}, {n, n + 1, 0.5}}};
  };
  double total = 0.0;
  for (const Part& a : parts(d)) {
    for (const Part& b : parts(e)) {
      Range r = grid.edges(d, e);
      r.lower[d] = a.lower;
      r.upper[d] = a.upper;
      r.lower[e] = b.lower;
      r.upper[e] = b.upper;
      if (a.weight * b.weight > 0.0) total += a.weight * b.weight * sum_over(grid.cells, r, body);
    }
  }
  return total;
}

// Power [W] that moving walls give to a phase whose shear stress [Pa] on the edge with index c of plane (d,
// e) is stress(d, e)(c).
template <typename Stress>
double wall_power(const Grid& grid, const Boundary& boundary, Stress&& stress) {
  double total = 0.0;
  for (int d = 0; d < grid.dim; ++d) {
    if (grid.cells.periodic[d]) continue;
    for (int upper = 0; upper < 2; ++upper) {
      for (int e = 0; e < grid.dim; ++e) {
        const double speed = boundary.side(d, upper).velocity[e];
        if (e == d || speed == 0.0) continue;
        Range wall = grid.all_faces(e);
        if (grid.cells.periodic[e]) wall.upper[e] -= 1;
        wall.lower[d] = upper ? grid.cells.n[d] : 0;
        wall.upper[d] = wall.lower[d] + 1;
        const double sum = sum_over(grid.cells, wall, stress(std::min(d, e), std::max(d, e)));
        total += (upper ? 1.0 : -1.0) * speed * sum * grid.cell_volume / grid.h[d];
      }
    }
  }
  return total;
}

}  // namespace granvof
