// Level of the fluid pressure in a tank without an open side.
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/operators/mixture.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {

// Without a side that passes the fluid continuity (4) fixes P_c but for a constant, and what a solver leaves
// of it wanders by tens of Pa. The level of this program: the mean of P_c over the lid is zero, P_c taken
// from the uppermost cells to the lid, half a cell above, by the weight of the continuous phase in them. A
// pool at rest then has the pressure it has under an open top, where P_c = 0 everywhere. With a periodic
// vertical "the lid" is where the ends are joined. Adds a constant to p_c [Pa], interior cells only; a tank
// that is not sealed is left alone.
inline void set_pressure_level(const Grid& grid, const Scene& scene, const Field& alpha, Field& p_c) {
  if (!grid.sealed()) return;
  const double rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double half = 0.5 * normal_gravity(scene) * grid.h[1];
  const double* a = alpha.data();
  double* p = p_c.data();
  Range top = grid.all_cells();
  top.lower[1] = grid.cells.n[1] - 1;
  const char* solid = grid.obstacles.solid();
  const auto counts = [=](std::ptrdiff_t c) { return solid == nullptr || solid[c] == 0; };
  const double open = sum_over(grid.cells, top, [=](std::ptrdiff_t c) { return counts(c) ? 1.0 : 0.0; });
  if (open == 0.0) return;  // obstacles all along the lid: any level is as good
  const double mean = sum_over(grid.cells, top,
                               [=](std::ptrdiff_t c) {
                                 return counts(c) ? p[c] - half * mixture(a[c], rho_l, rho_g) : 0.0;
                               }) /
                      open;
  for_each(grid.cells, [=](std::ptrdiff_t c) { p[c] -= mean; });
}

}  // namespace granvof
