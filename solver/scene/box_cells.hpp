// Cells of a box whose faces lie on the grid's.
#pragma once

#include <array>
#include <cmath>

#include "solver/scene/scene.hpp"

namespace granvof {

struct BoxCells {
  std::array<int, 3> lower{0, 0, 0}, upper{1, 1, 1};  // half-open, [0, 1) along what is not computed
};

// `spacing` > 0 [m] along the first `dim` directions.
inline BoxCells cells_of(const Box& box, const Vec3& spacing, int dim) {
  BoxCells cells;
  for (int d = 0; d < dim; ++d) {
    cells.lower[d] = static_cast<int>(std::lround(box.lower[d] / spacing[d]));
    cells.upper[d] = static_cast<int>(std::lround(box.upper[d] / spacing[d]));
  }
  return cells;
}

}  // namespace granvof
