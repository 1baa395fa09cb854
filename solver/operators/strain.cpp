#include "solver/operators/strain.hpp"

namespace granvof {

StrainRate::StrainRate(const Grid& grid) : squared(grid), normal_squared(grid), divergence(grid) {
  for (int p = 0; p < (grid.dim == 2 ? 1 : 3); ++p) {
    shear[p] = Field(grid);
    plane_squared[p] = Field(grid);
  }
}

void StrainRate::update(const Grid& grid, const InnerWalls& walls, const FaceField& u, const Range& part) {
  double *sq = squared.data(), *normal = normal_squared.data(), *div = divergence.data();
  for_each(grid.cells, part, [=](std::ptrdiff_t c) { normal[c] = div[c] = 0.0; });
  for (int d = 0; d < grid.dim; ++d) {
    const double* v = u[d].data();
    const std::ptrdiff_t s = grid.stride(d);
    const double inv_h = 1.0 / grid.h[d];
    for_each(grid.cells, part, [=](std::ptrdiff_t c) {
      const double stretch = (v[c + s] - v[c]) * inv_h;
      div[c] += stretch;
      normal[c] += stretch * stretch;
    });
  }
  for_each(grid.cells, part, [=](std::ptrdiff_t c) { sq[c] = normal[c]; });
  for (int d = 0; d < grid.dim; ++d) {
    for (int e = d + 1; e < grid.dim; ++e) {
      const double *v = u[d].data(), *w = u[e].data();
      double* g = shear[plane_index(d, e)].data();
      double* plane = plane_squared[plane_index(d, e)].data();
      const std::ptrdiff_t s = grid.stride(d), t = grid.stride(e);
      const double inv_h = 1.0 / grid.h[d], inv_he = 1.0 / grid.h[e];
      for_each(grid.cells, Grid::edges(part, d, e),
               [=](std::ptrdiff_t c) { g[c] = (v[c] - v[c - t]) * inv_he + (w[c] - w[c - s]) * inv_h; });
      const Range edges = Grid::edges(part, d, e);
      for (const InnerWalls::Edge& edge : walls.edges(plane_index(d, e)))
        if (edges.contains(edge.place)) g[edge.at] *= edge.share;
      for_each(grid.cells, part, [=](std::ptrdiff_t c) {
        plane[c] = squared_shear_of_cell(g, c, s, t);
        sq[c] += plane[c];
      });
    }
  }
}

}  // namespace granvof
