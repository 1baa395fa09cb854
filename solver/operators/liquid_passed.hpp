// Liquid that passes the faces in a step.
#pragma once

#include "solver/grid/field.hpp"

namespace granvof {

struct LiquidPassed {
  FaceField through;  // of every face, along the axis, per area of the face [m]

  explicit LiquidPassed(const Grid& grid) : through(grid) {}
  void clear(const Grid& grid) {
    for (int d = 0; d < grid.dim; ++d) through[d].fill(0.0);
  }
  // Through a side, outwards [m3].
  double left(const Grid& grid, int d, bool upper) const {
    const double* liquid = through[d].data();
    const double area = grid.cell_volume / grid.h[d];
    return (upper ? area : -area) *
           sum_over(grid.cells, grid.side_faces(d, upper), [=](std::ptrdiff_t c) { return liquid[c]; });
  }
  // Through all of them [m3].
  double total(const Grid& grid) const {
    double sum = 0.0;
    grid.for_each_open_side([&](int d, bool upper) { sum += left(grid, d, upper); });
    return sum;
  }
};

}  // namespace granvof
