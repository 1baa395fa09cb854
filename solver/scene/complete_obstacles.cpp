#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"
#include "solver/scene/cut_off.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof::case_file {
namespace {

// On a face of cells, or refused with the nearest.
double on_a_face(const Completion& c, const std::string& key, double x, int axis) {
  const double cell = c.s.grid.spacing[axis], nearest = cell * std::round(x / cell);
  if (std::abs(x - nearest) > 1e-6 * cell)
    c.refuse(key, fmt::format("faces of cells, of {:.9g} m: {:.9g} lies in one, the nearest is {:.9g}", cell,
                              x, nearest));
  return nearest;
}

void obstacles_in_cells(const Completion& c) {
  c.only_in_3d("obstacle.z0");
  c.only_in_3d("obstacle.z1");
  ObstacleInput& input = c.d.obstacles;
  const std::size_t count = input.lower[0].size();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("obstacle.") + "xyz"[axis];
    std::vector<double>&lower = input.lower[axis], &upper = input.upper[axis];
    if (axis == 2 && lower.empty() && upper.empty()) {
      if (!c.flat()) lower.assign(count, 0.0);
      if (!c.flat()) upper.assign(count, c.s.tank[2]);
      continue;
    }
    const auto same_count = [&](const std::string& key, const std::vector<double>& list) {
      if (list.size() != count || count == 0)
        c.refuse(key, fmt::format("one number for each obstacle, as obstacle.x0 has {}", count));
    };
    same_count(name + "0", lower);
    same_count(name + "1", upper);
    for (std::size_t i = 0; i < count; ++i) {
      if (c.outside(lower[i], upper[i], axis) || upper[i] - lower[i] <= roundoff * c.s.tank[axis])
        c.refuse(name + "1",
                 fmt::format("boxes inside the tank of {} m, each beyond its {}0", c.s.tank[axis], name));
      lower[i] = on_a_face(c, name + "0", lower[i], axis);
      upper[i] = on_a_face(c, name + "1", upper[i], axis);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    Box box{{0.0, 0.0, 0.0}, c.s.tank};
    for (int axis = 0; axis < c.s.dimensions; ++axis) {
      box.lower[axis] = input.lower[axis][i];
      box.upper[axis] = input.upper[axis][i];
    }
    c.s.obstacles.push_back(box);
  }
}

// Length that two boxes share along an axis; z counts in 3D only.
bool overlap(const Completion& c, const Box& a, const Box& b) {
  for (int axis = 0; axis < c.s.dimensions; ++axis)
    if (std::min(a.upper[axis], b.upper[axis]) - std::max(a.lower[axis], b.lower[axis]) <=
        roundoff * c.s.tank[axis])
      return false;
  return true;
}

void keep_apart(const Completion& c) {
  for (const Box& obstacle : c.s.obstacles) {
    if (c.s.bed && overlap(c, obstacle, c.s.bed->box))
      c.refuse("obstacle.x0", "obstacles beside the bed: one lies in it");
    if (c.s.gate && c.s.gate->position > obstacle.lower[0] - 0.5 * c.s.grid.spacing[0] &&
        c.s.gate->position < obstacle.upper[0] + 0.5 * c.s.grid.spacing[0])
      c.refuse("obstacle.x0",
               fmt::format("obstacles beside the gate, which stands at {} m", c.s.gate->position));
  }
  for (int side = 0; side < 6; ++side) {
    if (c.s.sides[side].kind != SideKind::inlet && c.s.sides[side].kind != SideKind::outlet) continue;
    const int axis = side / 2;
    for (const Box& obstacle : c.s.obstacles) {
      const bool meets = side % 2 == 1 ? obstacle.upper[axis] > c.s.tank[axis] * (1.0 - roundoff)
                                       : obstacle.lower[axis] < c.s.tank[axis] * roundoff;
      if (meets) c.refuse("obstacle.x0", "obstacles that leave inlets and outlets free");
    }
  }
}

void let_out(const Completion& c) {
  for (int side = 0; side < 6; ++side) {
    if (c.s.sides[side].kind != SideKind::inlet || !is_cut_off(c.s, side)) continue;
    Scene without_gate = c.s;
    without_gate.gate.reset();
    const std::string way = fmt::format("leave a way out to what comes in at walls.{}", side_names[side]);
    if (!is_cut_off(without_gate, side))
      c.refuse("gate.speed", "no gate: before it rises it does not " + way);
    else if (c.has("obstacle"))
      c.refuse("obstacle.x0", "obstacles that " + way);
  }
}

}  // namespace

void complete_obstacles(Completion& c) {
  if (c.has("obstacle")) {
    c.rule({"scene.dimensions", "tank", "grid", "obstacle"}, [&] { obstacles_in_cells(c); });
    c.rule({"obstacle", "bed", "gate", "walls"}, [&] { keep_apart(c); });
  }
  c.rule({"scene.dimensions", "tank", "grid", "obstacle", "gate", "walls"}, [&] { let_out(c); });
}

}  // namespace granvof::case_file
