#include "solver/grid/obstacles.hpp"

#include <algorithm>
#include <cstdlib>

namespace granvof {
namespace {

std::array<int, 3> place_of(const Layout& l, std::ptrdiff_t c) {
  std::array<int, 3> at{};
  for (int d = 0; d < 3; ++d) {
    const int wide = l.n[d] + 2 * l.ghost[d];
    at[d] = static_cast<int>(c / l.stride[d] % wide) - l.ghost[d];
  }
  return at;
}

// Not beyond a side of the tank.
bool in_the_tank(const Layout& l, const std::array<int, 3>& at) {
  for (int d = 0; d < 3; ++d)
    if ((at[d] < 0 && !l.seam(d, false)) || (at[d] >= l.n[d] && !l.seam(d, true))) return false;
  return true;
}

// Places along d, ghosts included, that hold rows from `lower` to before `upper` of the whole tank or copies
// of them beyond joined ends. What stands at a side goes on beyond it.
std::vector<int> places_of(const Layout& l, int d, int lower, int upper) {
  std::vector<int> places;
  const int whole = l.whole[d];
  for (int at = -l.ghost[d]; at < l.n[d] + l.ghost[d]; ++at) {
    const int row = l.first[d] + at;
    const int inside = l.periodic[d] ? (row % whole + whole) % whole : std::clamp(row, 0, whole - 1);
    if (lower <= inside && inside < upper) places.push_back(at);
  }
  return places;
}

}  // namespace

Obstacles::Obstacles(const Layout& l, int dim, const Vec3& spacing, const std::vector<Box>& boxes,
                     const std::array<bool, 6>& flows) {
  if (boxes.empty()) return;
  solid_.assign(l.size, 0);
  for (const Box& box : boxes) fill(l, cells_of(box, spacing, dim));
  for (int d = 0; d < dim; ++d) {
    std::array<int, 3> end = l.n;
    end[d] += 1;
    for_each_place({{0, 0, 0}, end}, [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = l.index(at);
      if (is_solid(c) || is_solid(c - l.stride[d])) faces_[d].push_back(c);
    });
    for (int e = d + 1; e < dim; ++e) find_edges(l, d, e, flows);
  }
  find_surface(l, dim);
}

void Obstacles::fill(const Layout& l, const BoxCells& box) {
  std::array<std::vector<int>, 3> places;
  for (int d = 0; d < 3; ++d) places[d] = places_of(l, d, box.lower[d], box.upper[d]);
  const Range inside = Range::all(l);
  for (const int k : places[2])
    for (const int j : places[1])
      for (const int i : places[0]) {
        const std::ptrdiff_t c = l.index(i, j, k);
        if (!is_solid(c) && inside.contains({i, j, k})) cells_.push_back(c);
        solid_[static_cast<std::size_t>(c)] = 1;
      }
}

// Not those on closed sides of the tank, which are walls themselves.
void Obstacles::find_edges(const Layout& l, int d, int e, const std::array<bool, 6>& flows) {
  std::array<int, 3> lower{}, upper = l.n;
  for (const int axis : {d, e}) {
    lower[axis] = l.seam(axis, false) || flows[2 * axis] ? 0 : 1;
    if (l.seam(axis, true) || flows[2 * axis + 1]) upper[axis] += 1;
  }
  const std::ptrdiff_t s = l.stride[d], t = l.stride[e];
  for_each_place({lower, upper}, [&](const std::array<int, 3>& at) {
    Edge edge;
    edge.place = at;
    for (const int axis : {d, e}) {
      const bool first = at[axis] == 0, last = at[axis] == l.n[axis];
      edge.copy = edge.copy || (last && l.seam(axis, true));
      edge.on_side = edge.on_side || (last && !l.seam(axis, true)) || (first && !l.seam(axis, false));
    }
    edge.at = l.index(at);
    for (const std::ptrdiff_t c : {edge.at, edge.at - s, edge.at - t, edge.at - s - t})
      if (!is_solid(c)) edge.open[edge.cells++] = c;
    if (edge.cells == 0 || edge.cells == 4) return;
    const auto take = [&](int component, std::ptrdiff_t face, std::ptrdiff_t across) {
      if (!is_solid(face) && !is_solid(face - across)) edge.face[edge.faces++] = {component, face};
    };
    take(d, edge.at, s);
    take(d, edge.at - t, s);
    take(e, edge.at, t);
    take(e, edge.at - s, t);
    edge.flat = edge.cells == 2 && edge.faces == 1;
    if (edge.flat) {  // the open face is one of the direction along it
      edge.across = edge.face[0].first == d ? e : d;
      edge.above = edge.face[0].second == edge.at;
    }
    edges_[d + e - 1].push_back(edge);
  });
}

void Obstacles::find_surface(const Layout& l, int dim) {
  for (const std::ptrdiff_t c : cells_) {
    // Nearest first: through faces, else across edges and corners.
    for (int reach = 1; reach <= dim; ++reach) {
      Surface surface{c, {}};
      const int deep = dim == 3 ? 1 : 0;
      for_each_place({{-1, -1, -deep}, {2, 2, deep + 1}}, [&](const std::array<int, 3>& step) {
        if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) != reach) return;
        std::array<int, 3> at = place_of(l, c);
        for (int d = 0; d < 3; ++d) at[d] += step[d];
        if (!in_the_tank(l, at)) return;
        const std::ptrdiff_t other =
            c + step[0] * l.stride[0] + step[1] * l.stride[1] + step[2] * l.stride[2];
        if (!is_solid(other)) surface.beside.push_back(other);
      });
      if (surface.beside.empty()) continue;
      surface_.push_back(surface);
      break;
    }
  }
}

void Obstacles::extend(double* values) const {
  for (const Surface& surface : surface_) {
    double sum = 0.0;
    for (const std::ptrdiff_t c : surface.beside) sum += values[c];
    values[surface.cell] = sum / static_cast<double>(surface.beside.size());
  }
}

}  // namespace granvof
