#include "solver/operators/mixture.hpp"

#include <cmath>

#include "solver/grid/reduce.hpp"

namespace granvof {

void FaceInertia::update(const Grid& grid, const Scene& scene, const Field& f_s_cell, const Field& alpha) {
  const double rho_s = scene.solid.density, rho_l = scene.liquid.density, rho_g = scene.gas.density;
  const double* f = f_s_cell.data();
  const double* a = alpha.data();
  holds_grains = max_over(grid.cells, grid.cells_and_ghosts(1), 0.0,
                          [=](std::ptrdiff_t c) { return std::fabs(f[c]); }) != 0.0;
  for (int d = 0; d < grid.dim; ++d) {
    const std::ptrdiff_t s = grid.stride(d);
    double* face = f_s[d].data();
    double* m_s = solid[d].data();
    double* m_c = fluid[d].data();
    for_each(grid.cells, grid.cells_and_ghosts(1), [=](std::ptrdiff_t c) {
      const double fs = 0.5 * (f[c] + f[c - s]);
      face[c] = fs;
      m_s[c] = fs * rho_s;
      m_c[c] = face_mass(f[c - s], a[c - s], f[c], a[c], rho_l, rho_g);
    });
  }
  grid.for_each_passing_side([&](int d, bool upper) {
    const std::ptrdiff_t s = grid.stride(d), inside = upper ? -s : 0, beyond = upper ? 0 : -s;
    double *face = f_s[d].data(), *m_s = solid[d].data(), *m_c = fluid[d].data();
    for_each(grid.cells, grid.side_faces(d, upper), [=](std::ptrdiff_t c) {
      face[c] = f[c + inside];
      m_s[c] = f[c + inside] * rho_s;
      m_c[c] = passing_side_mass((1.0 - f[c + inside]) * mixture(a[c + inside], rho_l, rho_g),
                                 (1.0 - f[c + beyond]) * mixture(a[c + beyond], rho_l, rho_g));
    });
  });
}

}  // namespace granvof
