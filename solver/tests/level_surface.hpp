// A surface of liquid that is level, however the tank lies to it.
#pragma once

#include <cmath>

#include "solver/operators/plane_in_cell.hpp"
#include "solver/scene/gravity.hpp"
#include "solver/state/state.hpp"

namespace granvof::test {

// alpha of liquid below a plane across g that passes through the place (x, y), ghosts included; 2D planes.
inline Field level_surface(const Grid& grid, const Scene& scene, double x, double y) {
  const Vec3 g = gravity_of(scene);
  const double up[2] = {-g[0] / scene.gravity, -g[1] / scene.gravity};
  const std::array<double, 3> normal{std::fabs(up[0]) * grid.h[0], std::fabs(up[1]) * grid.h[1], 0.0};
  Field alpha(grid);
  for_each_place(grid.cells_and_ghosts(ghost_layers), [&](const std::array<int, 3>& at) {
    const double lowest_x = (at[0] + (up[0] < 0.0 ? 1 : 0)) * grid.h[0],
                 lowest_y = (at[1] + (up[1] < 0.0 ? 1 : 0)) * grid.h[1];
    alpha[grid.cells.index(at)] = volume_below(normal, up[0] * (x - lowest_x) + up[1] * (y - lowest_y));
  });
  return alpha;
}

}  // namespace granvof::test
