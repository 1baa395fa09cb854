// Strain rate of a staggered velocity: S = (grad u + grad u^T) / 2.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/grid/field.hpp"
#include "solver/grid/inner_walls.hpp"

namespace granvof {

// The edge field of plane (d, e) has index d + e - 1: xy 0, xz 1, yz 2.
inline int plane_index(int d, int e) {
  return d + e - 1;
}

struct StrainRate {
  std::array<Field, 3> shear;          // 2 S_de = du_d/dx_e + du_e/dx_d on the edges of plane (d, e) [1/s]
  Field squared;                       // S:S at cell centres [1/s2]
  Field normal_squared;                // its part from the normal strains
  std::array<Field, 3> plane_squared;  // its part from the shear of each plane
  Field divergence;                    // div u at cell centres [1/s]

  explicit StrainRate(const Grid& grid);
  // One ghost layer of u must be filled.
  void update(const Grid& grid, const InnerWalls& walls, const FaceField& u) {
    update(grid, walls, u, grid.all_cells());
  }
  // The same for a part of the cells and their edges; other values stay as they are.
  void update(const Grid& grid, const InnerWalls& walls, const FaceField& u, const Range& part);
};

// gamma = 2 ||S'|| of a cell with S:S = squared and div u = div [1/s], S' the deviator of S: the rate at
// which grains are sheared past each other.
inline double deviatoric_shear_rate(double squared, double div) {
  return std::sqrt(2.0 * std::max(squared - div * div / 3.0, 0.0));
}

// 2 S_de^2 = g^2 / 2 of cell c [1/s2], the mean over its four edges; g: shear of a plane on edges, s and t:
// strides of its directions.
inline double squared_shear_of_cell(const double* g, std::ptrdiff_t c, std::ptrdiff_t s, std::ptrdiff_t t) {
  return 0.125 * (g[c] * g[c] + g[c + s] * g[c + s] + g[c + t] * g[c + t] + g[c + s + t] * g[c + s + t]);
}

}  // namespace granvof
