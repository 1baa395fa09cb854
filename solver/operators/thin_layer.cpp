#include "solver/operators/thin_layer.hpp"

#include <cmath>

#include "solver/closures/contact_friction.hpp"

namespace granvof {

void arrest_thin_layers(const Grid& grid, const Scene& scene, const Field& f_s, Field& friction) {
  friction.fill(0.0);
  if (!scene.model.contact_friction) return;
  const SideRule& floor = grid.side(1, false);
  const bool on_floor = floor.bears_grains && std::isinf(floor.friction);
  const double mu_s = scene.solid.friction, mu_2 = scene.contact.fast_friction, d_s = scene.solid.diameter;
  const double length = scene.contact.stop_length, packed = scene.contact.solid_fraction_min, h = grid.h[1];
  const double* f = f_s.data();
  const char* solid = grid.obstacles.solid();
  double* out = friction.data();
  const std::ptrdiff_t up = grid.stride(1);
  const int rows = grid.cells.n[1];
  Range lowest = grid.all_cells();
  lowest.upper[1] = 1;
  for_each(grid.cells, lowest, [=](std::ptrdiff_t column) {
    for (int bottom = 0; bottom < rows; ++bottom) {
      const std::ptrdiff_t c = column + bottom * up;
      const bool rests = bottom == 0 ? on_floor : solid != nullptr && solid[c - up] != 0;
      if (!rests) continue;
      int top = 0;
      double grains = 0.0;
      while (bottom + top < rows && f[c + top * up] >= 0.5 * packed) grains += f[c + top++ * up];
      const double stop = closures::arrest_friction(grains / packed * h, mu_s, mu_2, length, d_s);
      for (int j = 0; j < top; ++j) out[c + j * up] = stop;
    }
  });
}

}  // namespace granvof
