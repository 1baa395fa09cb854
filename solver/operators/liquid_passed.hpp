// Liquid that passes the faces in a step.
#pragma once

#include <array>
#include <numeric>

#include "solver/grid/field.hpp"

namespace granvof {

struct LiquidPassed {
  std::array<double, 6> left{};  // through the sides, outwards, by SideIndex [m3]
  FaceField through;             // of every face, along the axis, per area of the face [m]

  explicit LiquidPassed(const Grid& grid) : through(grid) {}
  void clear(const Grid& grid) {
    left = {};
    for (int d = 0; d < grid.dim; ++d) through[d].fill(0.0);
  }
  double total() const { return std::accumulate(left.begin(), left.end(), 0.0); }
};

}  // namespace granvof
