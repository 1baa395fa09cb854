// A small box with everything an operator needs, and fields given as functions of position.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "solver/grid/boundary.hpp"
#include "solver/state/state.hpp"

namespace granvof::test {

inline Scene box_scene(int dim, std::array<int, 3> cells, Vec3 tank, WallKind kind = WallKind::slip) {
  Scene scene;
  scene.name = "box";
  scene.dimensions = dim;
  scene.tank = tank;
  scene.grid.cells = cells;
  for (int d = 0; d < 3; ++d) scene.grid.spacing[d] = tank[d] / cells[d];
  scene.gas = {1.0, 1e-5};
  scene.liquid = {1000.0, 1e-3};
  scene.solid = {2500.0, 0.8e-3, 0.9, 0.4};
  for (Side& side : scene.sides) side.fluid.kind = side.solid.kind = kind;
  return scene;
}

// n x n cells of the unit square (n x n x n of the unit cube in 3D), closed by slip walls.
inline Scene unit_scene(int dim, int n, WallKind kind = WallKind::slip) {
  return box_scene(dim, {n, n, dim == 3 ? n : 1}, {1.0, 1.0, 1.0}, kind);
}

inline void make_periodic(Scene& scene, int d) {
  scene.sides[2 * d].kind = scene.sides[2 * d + 1].kind = SideKind::periodic;
}

struct Tank {
  explicit Tank(Scene given, const Communicator* processes = nullptr)
      : scene(std::move(given)), grid(scene, processes), boundary(grid) {}
  Tank(const Tank&) = delete;
  Tank& operator=(const Tank&) = delete;
  Tank(Tank&&) = delete;
  Tank& operator=(Tank&&) = delete;
  ~Tank() = default;

  // visit(i, j, k, index)
  template <typename Visit>
  void each(const Range& r, Visit&& visit) const {
    for (int k = r.lower[2]; k < r.upper[2]; ++k)
      for (int j = r.lower[1]; j < r.upper[1]; ++j)
        for (int i = r.lower[0]; i < r.upper[0]; ++i) visit(i, j, k, grid.cells.index(i, j, k));
  }
  template <typename Visit>
  void each_cell(Visit&& visit) const {
    each(grid.all_cells(), visit);
  }

  Vec3 centre(int i, int j, int k) const {
    return {(i + 0.5) * grid.h[0], (j + 0.5) * grid.h[1], (k + 0.5) * grid.h[2]};
  }
  Vec3 face(int d, int i, int j, int k) const {
    Vec3 x = centre(i, j, k);
    x[d] -= 0.5 * grid.h[d];
    return x;
  }

  using Function = std::function<double(const Vec3&)>;
  // Cells, all ghosts included.
  Field cells(const Function& value) const {
    Field f(grid);
    each(grid.cells_and_ghosts(ghost_layers),
         [&](int i, int j, int k, std::ptrdiff_t c) { f[c] = value(centre(i, j, k)); });
    return f;
  }
  // Faces, all ghosts included: component d at its own faces.
  FaceField faces(const std::array<Function, 3>& value) const {
    FaceField u(grid);
    for (int d = 0; d < grid.dim; ++d)
      each(grid.cells_and_ghosts(ghost_layers),
           [&](int i, int j, int k, std::ptrdiff_t c) { u[d][c] = value[d](face(d, i, j, k)); });
    return u;
  }
  // At rest, without pressures, grains and liquid everywhere alike; they touch at f_s,min.
  State uniform_state(double f_s, double alpha = 1.0) const {
    State state(grid);
    state.f_s.fill(f_s);
    state.alpha.fill(alpha);
    state.packing.fill(scene.contact.solid_fraction_min);
    return state;
  }
  // Random values on the inner faces, 0 on closed sides, periodic ghosts filled.
  FaceField random_faces(double lower, double upper) {
    FaceField u(grid);
    for (int d = 0; d < grid.dim; ++d) {
      each(grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) { u[d][c] = uniform(lower, upper); });
      boundary.exchange(u[d]);
    }
    return u;
  }
  Field random_cells(double lower, double upper) {
    Field f(grid);
    each_cell([&](int, int, int, std::ptrdiff_t c) { f[c] = uniform(lower, upper); });
    boundary.fill_scalar(f);
    return f;
  }
  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  }
  double total(const Field& f) const {
    double sum = 0.0;
    each_cell([&](int, int, int, std::ptrdiff_t c) { sum += f[c]; });
    return sum;
  }
  double smallest(const Field& f) const {
    double least = INFINITY;
    each_cell([&](int, int, int, std::ptrdiff_t c) { least = std::fmin(least, f[c]); });
    return least;
  }
  double largest(const Field& f) const {
    double most = -INFINITY;
    each_cell([&](int, int, int, std::ptrdiff_t c) { most = std::fmax(most, f[c]); });
    return most;
  }
  // div(flux) of a cell [1/s]
  double divergence(const FaceField& flux, std::ptrdiff_t c) const {
    double sum = 0.0;
    for (int d = 0; d < grid.dim; ++d) sum += (flux[d][c + grid.stride(d)] - flux[d][c]) / grid.h[d];
    return sum;
  }

  Scene scene;
  Grid grid;
  Boundary boundary;
  std::mt19937 random{11};
};

}  // namespace granvof::test
