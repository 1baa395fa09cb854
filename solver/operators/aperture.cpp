#include "solver/operators/aperture.hpp"

#include <algorithm>
#include <cmath>

namespace granvof {

Aperture::Aperture(const Grid& grid, const Scene& scene) : grid_(grid), gate_(scene.gate), open_(grid, 0.0) {
  for (int d = 0; d < grid.dim; ++d) {
    double* open = open_[d].data();
    // Faces on a seam have their copies in the ghosts, so the range includes both ends there.
    Range r = grid.fluid_faces(d);
    if (grid.cells.seam(d, true)) r.upper[d] += 1;
    for_each(grid.cells, r, [=](std::ptrdiff_t c) { open[c] = 1.0; });
  }
  for (int d = 0; d < grid.dim; ++d)
    for (const std::ptrdiff_t face : grid.obstacles.faces(d)) open_[d][face] = 0.0;
  if (gate_) {
    const int n = grid.cells.whole[0];
    const int nearest = static_cast<int>(std::lround(gate_->position / grid.h[0]));
    gate_face_ = grid.cells.periodic[0] ? nearest % n : std::clamp(nearest, 1, n - 1);
    update(-1.0);
  }
}

bool Aperture::update(double time) {
  if (!gate_) return false;
  // A row is free once the lower edge has passed its centre.
  const double edge = gate_->speed * std::max(time, 0.0);
  const int rows = std::clamp(static_cast<int>(std::floor(edge / grid_.h[1] + 0.5)), 0, grid_.cells.n[1]);
  if (rows == open_rows_) return false;
  open_rows_ = rows;
  const Layout& l = grid_.cells;
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j) {
      const double open = j < rows ? 1.0 : 0.0;
      for (const int face :
           {gate_face_, gate_face_ + l.whole[0]}) {  // and what is a copy of it beyond a seam
        const int here = face - l.first[0];
        if (here >= 0 && here < l.n[0] + (l.seam(0, true) ? 1 : 0)) open_[0][l.index(here, j, k)] = open;
      }
    }
  return true;
}

}  // namespace granvof
