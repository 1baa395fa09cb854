// Sums by which a viscous stress on the staggered grid works: its dissipation on edges, and moving walls.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/grid/sum_of_parts.hpp"

namespace granvof {

// Whether rows of cells along d end there at a side that passes no fluid.
inline bool ends_closed(const Grid& grid, int d, bool upper) {
  return !grid.cells.seam(d, upper) && !grid.side(d, upper).passes_fluid;
}

// Sum of weight * body(edge) over the edges of plane (d, e). An edge on a side counts half: the stress there
// acts on one row of faces only. Seams count once. In a corner of two closed sides the stress acts on
// no face whose momentum is solved, and does no work.
template <typename Body>
double sum_over_edges(const Grid& grid, int d, int e, Body&& body) {
  struct Stretch {
    int lower, upper;
    double weight;
    bool closed;
  };
  const auto stretches = [&](int direction) {
    const int n = grid.cells.n[direction];
    const bool below = !grid.cells.seam(direction, false), above = !grid.cells.seam(direction, true);
    return std::array<Stretch, 3>{{{0, 1, below ? 0.5 : 0.0, ends_closed(grid, direction, false)},
                                   {below ? 1 : 0, n, 1.0, false},
                                   {n, n + 1, above ? 0.5 : 0.0, ends_closed(grid, direction, true)}}};
  };
  SumOfParts sum(grid.cells);
  for (const Stretch& a : stretches(d)) {
    for (const Stretch& b : stretches(e)) {
      if (a.weight * b.weight == 0.0 || (a.closed && b.closed)) continue;
      Range r = grid.edges(d, e);
      r.lower[d] = a.lower;
      r.upper[d] = a.upper;
      r.lower[e] = b.lower;
      r.upper[e] = b.upper;
      sum.add(a.weight * b.weight, r, body);
    }
  }
  return sum.total();
}

// Power [W] that moving walls give to a phase whose shear stress [Pa] on the edge with index c of plane (d,
// e) is stress(d, e)(c).
template <typename Stress>
double wall_power(const Grid& grid, const Boundary& boundary, Stress&& stress) {
  SumOfParts sum(grid.cells);
  for (int d = 0; d < grid.dim; ++d) {
    for (int upper = 0; upper < 2; ++upper) {
      if (grid.cells.seam(d, upper == 1)) continue;
      for (int e = 0; e < grid.dim; ++e) {
        const double speed = boundary.side(d, upper).velocity[e];
        if (e == d || speed == 0.0) continue;
        const auto of_edge = stress(std::min(d, e), std::max(d, e));
        const double power = (upper ? 1.0 : -1.0) * speed * grid.cell_volume / grid.h[d];
        const auto add_on_wall = [&](double weight, Range faces) {  // those of component e along the wall
          faces.lower[d] = upper ? grid.cells.n[d] : 0;
          faces.upper[d] = faces.lower[d] + 1;
          sum.add(weight * power, faces, of_edge);
        };
        add_on_wall(1.0, grid.inner_faces(e));
        for (const bool far : {false, true})
          if (grid.side(e, far).passes_fluid) add_on_wall(0.5, grid.side_faces(e, far));
      }
    }
  }
  return sum.total();
}

}  // namespace granvof
