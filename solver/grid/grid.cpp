#include "solver/grid/grid.hpp"

#include "solver/grid/slabs.hpp"

namespace granvof {

namespace {

Layout layout_of(const Scene& scene, const Communicator* communicator) {
  std::array<int, 3> n = scene.grid.cells, ghost{};
  std::array<bool, 3> periodic{};
  for (int d = 0; d < scene.dimensions; ++d) {
    ghost[d] = ghost_layers;
    periodic[d] = side_rule(scene, 2 * d).joined;
  }
  if (scene.dimensions == 2) n[2] = 1;
  Layout cells = Layout::make(n, ghost, periodic);
  cells.communicator = communicator;
  if (communicator == nullptr || communicator->size() == 1) return cells;
  return slab_of(cells, scene.dimensions, communicator->size(), communicator->rank());
}

std::array<bool, 6> sides_that_pass(const Scene& scene) {
  std::array<bool, 6> flows{};
  for (int side = 0; side < 2 * scene.dimensions; ++side) flows[side] = side_rule(scene, side).is_open();
  return flows;
}

}  // namespace

Grid::Grid(const Scene& scene, const Communicator* communicator)
    : dim(scene.dimensions),
      cells(layout_of(scene, communicator)),
      h(scene.grid.spacing),
      obstacles(cells, dim, h, scene.obstacles, sides_that_pass(scene)) {
  for (int side = 0; side < 6; ++side) {
    tank_sides[side] = side_rule(scene, side);
    const bool seam = side < 2 * dim && cells.seam(side / 2, side % 2 == 1);
    sides[side] = seam ? periodic_rule() : tank_sides[side];
  }
  if (dim == 2) h[2] = scene.tank[2];
  cell_volume = h[0] * h[1] * h[2];
}

bool Grid::has_whole_columns() const {
  bool only_the_top = obstacles.none();
  for (int d = 0; d < dim; ++d)
    for (const bool upper : {false, true})
      if (tank_side(d, upper).is_open()) only_the_top = only_the_top && d == vertical && upper;
  return only_the_top;
}

bool Grid::has_bumps() const {
  for (int d = 0; d < dim; ++d)
    for (const bool upper : {false, true})
      if (tank_side(d, upper).bumps) return true;
  return false;
}

bool Grid::sealed() const {
  for (int d = 0; d < dim; ++d)
    for (const bool upper : {false, true})
      if (tank_side(d, upper).passes_fluid) return false;
  return true;
}

Range Grid::cells_and_ghosts(int layers) const {
  Range r = all_cells();
  for (int d = 0; d < dim; ++d) {
    r.lower[d] -= layers;
    r.upper[d] += layers;
  }
  return r;
}

Range Grid::inner_faces(int d) const {
  Range r = all_cells();
  if (!cells.seam(d, false)) r.lower[d] = 1;
  return r;
}

Range Grid::fluid_faces(int d) const {
  Range r = inner_faces(d);
  if (side(d, false).passes_fluid) r.lower[d] -= 1;
  if (side(d, true).passes_fluid) r.upper[d] += 1;
  return r;
}

Range Grid::flux_faces(int d) const {
  Range r = inner_faces(d);
  if (side(d, false).is_open()) r.lower[d] -= 1;
  if (side(d, true).is_open()) r.upper[d] += 1;
  return r;
}

Range Grid::side_faces(int d, bool upper) const {
  Range r = all_cells();
  r.lower[d] = upper ? cells.n[d] : 0;
  r.upper[d] = r.lower[d] + (has_side(d, upper) ? 1 : 0);
  return r;
}

Range Grid::side_cells(int d, bool upper) const {
  Range r = all_cells();
  r.lower[d] = upper ? cells.n[d] - 1 : 0;
  r.upper[d] = r.lower[d] + (has_side(d, upper) ? 1 : 0);
  return r;
}

Range Grid::all_faces(int d) const {
  Range r = all_cells();
  r.upper[d] += 1;
  return r;
}

Layout Grid::face_layout(int d) const {
  Layout l = cells;
  if (!l.seam(d, true)) l.n[d] += 1;
  if (!l.periodic[d]) l.whole[d] += 1;
  return l;
}

Range Grid::edges(Range cells, int d, int e) {
  cells.upper[d] += 1;
  cells.upper[e] += 1;
  return cells;
}

}  // namespace granvof
