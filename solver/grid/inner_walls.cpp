#include "solver/grid/inner_walls.hpp"

#include <algorithm>

namespace granvof {
namespace {

constexpr int furthest_sight = 3;  // in cells, from a wall to what may see it

// All faces of direction d whose cells are both in memory.
Range all_but_the_first(const Layout& l, int d) {
  Range r;
  for (int e = 0; e < 3; ++e) {
    r.lower[e] = -l.ghost[e];
    r.upper[e] = l.n[e] + l.ghost[e];
  }
  if (l.ghost[d] > 0) r.lower[d] += 1;
  return r;
}

}  // namespace

InnerWalls::InnerWalls(const Grid& grid) : grid_(grid), solid_(grid.obstacles.solid()) {
  if (grid.obstacles.none()) return;
  const Layout& l = grid.cells;
  for (int d = 0; d < grid.dim; ++d) {
    closed_[d].assign(l.size, 0);
    for_each_place(all_but_the_first(l, d), [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = l.index(at);
      closed_[d][static_cast<std::size_t>(c)] = is_solid(c) || is_solid(c - l.stride[d]) ? 1 : 0;
    });
  }
  list(all_but_the_first(l, 0));
}

void InnerWalls::shut_gate(int face, int open_rows) {
  const Layout& l = grid_.cells;
  for (int d = 0; d < grid_.dim; ++d)
    if (closed_[d].empty()) closed_[d].assign(l.size, 0);
  const Range all = all_but_the_first(l, 0);
  for (const int copy : {face - l.whole[0], face, face + l.whole[0]}) {  // beyond a seam
    Range plate = all;
    plate.lower[0] = copy - l.first[0];
    plate.upper[0] = plate.lower[0] + 1;
    if (plate.lower[0] < all.lower[0] || plate.lower[0] >= all.upper[0]) continue;
    if (copy != face && !l.periodic[0]) continue;
    for_each_place(plate, [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = l.index(at);
      const bool stands = open_rows < l.n[1] && (open_rows == 0 || at[1] >= open_rows);
      closed_[0][static_cast<std::size_t>(c)] = stands || is_solid(c) || is_solid(c - l.stride[0]) ? 1 : 0;
    });
  }
  Range near = all;
  if (grid_.obstacles.none() && !l.periodic[0]) {
    near.lower[0] = face - l.first[0] - furthest_sight;
    near.upper[0] = face - l.first[0] + furthest_sight + 1;
  }
  list(near);
}

bool InnerWalls::wall_between(std::ptrdiff_t c, int d, int e, bool up) const {
  const std::ptrdiff_t beside = up ? c + grid_.stride(e) : c;
  return is_closed(e, beside) && is_closed(e, beside - grid_.stride(d));
}

double InnerWalls::share_across(std::ptrdiff_t c, int d, int e, bool up) const {
  const std::ptrdiff_t t = grid_.stride(e), beyond = up ? c + t : c - t;
  return is_solid(beyond) || is_solid(beyond - grid_.stride(d)) ? -1.0 : 1.0;
}

bool InnerWalls::in_sight(std::ptrdiff_t c, int d) const {
  const std::ptrdiff_t s = grid_.stride(d);
  if (is_closed(d, c + s) || is_closed(d, c - s)) return true;
  for (int e = 0; e < grid_.dim; ++e) {
    if (e == d) continue;
    const std::ptrdiff_t t = grid_.stride(e);
    for (const bool up : {false, true})
      if (wall_between(c, d, e, up) || wall_between(up ? c + t : c - t, d, e, up)) return true;
  }
  return false;
}

bool InnerWalls::beside_wall(std::ptrdiff_t c) const {
  const int deep = grid_.dim == 3 ? 1 : 0;
  bool found = false;
  for_each_place({{-1, -1, -deep}, {2, 2, deep + 1}}, [&](const std::array<int, 3>& step) {
    std::ptrdiff_t other = c;
    for (int d = 0; d < grid_.dim; ++d) other += step[d] * grid_.stride(d);
    for (int d = 0; d < grid_.dim; ++d)
      if (step[d] >= 0) found = found || is_closed(d, other);
  });
  return found;
}

void InnerWalls::list(const Range& near) {
  const Layout& l = grid_.cells;
  for (auto& faces : faces_) faces.clear();
  for (auto& faces : closed_faces_) faces.clear();
  for (auto& edges : edges_) edges.clear();
  cells_.clear();
  for (int d = 0; d < grid_.dim; ++d) {
    for_each_place(common(grid_.all_faces(d), near), [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = l.index(at);
      if (is_closed(d, c))
        closed_faces_[d].push_back({at, c});
      else if (in_sight(c, d))
        faces_[d].push_back({at, c});
    });
    for (int e = d + 1; e < grid_.dim; ++e) list_edges(d, e, near);
  }
  Range with_beyond = grid_.all_cells();
  for (int d = 0; d < grid_.dim; ++d) with_beyond.lower[d] -= l.seam(d, false) ? 1 : 0;
  for_each_place(common(with_beyond, near), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = l.index(at);
    if (!is_solid(c) && beside_wall(c)) cells_.push_back({at, c});
  });
}

// Of obstacles those along flat surfaces; of the gate those between two of its faces.
void InnerWalls::list_edges(int d, int e, const Range& near) {
  for (const Obstacles::Edge& edge : grid_.obstacles.edges(d + e - 1))
    if (edge.flat) edges_[d + e - 1].push_back({{edge.place, edge.at}, 2.0});
  const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
  for_each_place(common(grid_.edges(d, e), near), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = grid_.cells.index(at);
    const bool solid = is_solid(c) || is_solid(c - s) || is_solid(c - t) || is_solid(c - s - t);
    const bool upright = is_closed(d, c) && is_closed(d, c - t),
               flat = is_closed(e, c) && is_closed(e, c - s);
    if (!solid && (upright || flat)) edges_[d + e - 1].push_back({{at, c}, 0.0});
  });
}

std::array<double, 4> InnerWalls::cells_across(const double* v, std::ptrdiff_t c, int d) const {
  const std::ptrdiff_t s = grid_.stride(d);
  const bool wall_below = is_closed(d, c - s), wall_above = is_closed(d, c + s);
  return {wall_below ? v[c - s] : v[c - 2 * s], v[c - s], v[c], wall_above ? v[c] : v[c + s]};
}

double InnerWalls::cell_beside(const double* v, std::ptrdiff_t c, const std::array<int, 3>& step) const {
  std::array<int, 3> order{0, 1, 2};
  double sum = 0.0;
  int ways = 0;
  do {
    std::ptrdiff_t at = c;
    for (const int d : order) {
      if (step[d] == 0) continue;
      const std::ptrdiff_t s = grid_.stride(d);
      if (step[d] > 0 && !is_closed(d, at + s)) at += s;
      if (step[d] < 0 && !is_closed(d, at)) at -= s;
    }
    sum += v[at];
    ++ways;
  } while (std::ranges::next_permutation(order).found);
  return sum / ways;
}

InnerWalls::Line InnerWalls::faces_along(const double* v, std::ptrdiff_t c, int d, int e) const {
  const std::ptrdiff_t t = grid_.stride(e);
  Line line;
  line[2] = v[c];
  for (const bool up : {false, true}) {
    const std::ptrdiff_t step = up ? t : -t;
    const int one = up ? 3 : 1, two = up ? 4 : 0;
    if (e == d) {
      line[one] = v[c + step];
      const std::ptrdiff_t beyond = c + 2 * step;  // from a side of the tank there is none
      const bool there = beyond >= 0 && beyond < static_cast<std::ptrdiff_t>(grid_.cells.size);
      line[two] = is_closed(d, c + step) ? -v[c] : there ? v[beyond] : line[one];
    } else if (wall_between(c, d, e, up)) {
      line[one] = line[two] = share_across(c, d, e, up) * v[c];
    } else {
      line[one] = v[c + step];
      line[two] =
          wall_between(c + step, d, e, up) ? share_across(c + step, d, e, up) * v[c + step] : v[c + 2 * step];
    }
  }
  return line;
}

}  // namespace granvof
