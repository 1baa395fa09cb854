// Liquid that passes the open sides in a step.
#pragma once

#include <array>
#include <numeric>

#include "solver/grid/field.hpp"

namespace granvof {

struct SideLiquid {
  std::array<double, 6> left{};  // outwards, by SideIndex [m3]
  // Of every face of an open side, along the axis, per area of the face [m]; empty where a direction has no
  // such side.
  FaceField through;

  explicit SideLiquid(const Grid& grid) {
    grid.for_each_open_side([&](int d, bool) { through[d] = Field(grid); });
  }
  void clear(const Grid& grid) {
    left = {};
    grid.for_each_open_side([&](int d, bool) { through[d].fill(0.0); });
  }
  double total() const { return std::accumulate(left.begin(), left.end(), 0.0); }
};

}  // namespace granvof
