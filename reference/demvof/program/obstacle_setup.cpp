#include "reference/demvof/program/obstacle_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "reference/demvof/program/scene_setup.hpp"
#include "solver/scene/box_cells.hpp"

namespace demvof {

namespace {

using granvof::Scene;
using Place = std::array<int, 3>;

template <class Visit>
void for_each(const Place& lower, const Place& upper, Visit&& visit) {
  for (int k = lower[2]; k < upper[2]; ++k)
    for (int j = lower[1]; j < upper[1]; ++j)
      for (int i = lower[0]; i < upper[0]; ++i) visit(Place{i, j, k});
}

// Free cells by the parts in which they hang together through faces; the gate stands.
class Parts {
 public:
  Parts(const Obstacles& obstacles, int gate) : obstacles_(obstacles), gate_(gate), seen_(obstacles.closed) {
    for_each({0, 0, 0}, obstacles.cells, [&](const Place& at) {
      if (!seen(at)) fill(at);
    });
  }
  int count() const { return count_; }
  int below_the_top() const { return below_the_top_; }  // those that do not reach the tank's top

 private:
  std::vector<char>::reference seen(const Place& at) { return seen_[obstacles_.index(at)]; }

  void fill(const Place& first) {
    bool top = false;
    std::vector<Place> left{first};
    seen(first) = 1;
    while (!left.empty()) {
      const Place at = left.back();
      left.pop_back();
      top = top || at[1] == obstacles_.cells[1] - 1;
      for (std::size_t side = 0; side < 6; ++side) {
        Place next = at;
        next[side / 2] += side % 2 == 1 ? 1 : -1;
        const bool through_gate = side < 2 && std::max(at[0], next[0]) == gate_;
        if (next[side / 2] < 0 || next[side / 2] >= obstacles_.cells[side / 2] || through_gate) continue;
        if (seen(next) != 0) continue;
        seen(next) = 1;
        left.push_back(next);
      }
    }
    ++count_;
    below_the_top_ += top ? 0 : 1;
  }

  const Obstacles& obstacles_;
  int gate_;
  std::vector<char> seen_;
  int count_ = 0, below_the_top_ = 0;
};

// Some two cells beside each other along two or three directions are free, and no way through faces leads
// from one to the other between them: no surface parts beads and fluid there that either could be told of.
bool touch_along_an_edge_alone(const Obstacles& o) {
  bool found = false;
  for (const Place& size : {Place{2, 2, 1}, Place{2, 1, 2}, Place{1, 2, 2}, Place{2, 2, 2}}) {
    Place upper = o.cells;
    for (std::size_t d = 0; d < 3; ++d) upper[d] -= size[d] - 1;
    for_each({0, 0, 0}, upper, [&](const Place& corner) {
      Obstacles block;
      block.cells = size;
      for_each({0, 0, 0}, size, [&](const Place& at) {
        block.closed.push_back(o.fill({corner[0] + at[0], corner[1] + at[1], corner[2] + at[2]}) ? 1 : 0);
      });
      found = found || Parts(block, -1).count() > 1;
    });
  }
  return found;
}

}  // namespace

Obstacles obstacles_on(const Scene& gridded) {
  Obstacles o;
  o.cells = gridded.grid.cells;
  o.spacing = gridded.grid.spacing;
  if (gridded.dimensions == 2) o.spacing[2] = depth_of(gridded);
  if (gridded.obstacles.empty()) return o;
  o.closed.assign(static_cast<std::size_t>(o.cells[0]) * static_cast<std::size_t>(o.cells[1]) *
                      static_cast<std::size_t>(o.cells[2]),
                  0);
  for (const granvof::Box& box : gridded.obstacles) {
    const granvof::BoxCells cells = granvof::cells_of(box, o.spacing, gridded.dimensions);
    for_each(cells.lower, cells.upper, [&](const Place& at) { o.closed[o.index(at)] = 1; });
  }
  return o;
}

std::string obstacles_refused(const Scene& gridded) {
  if (gridded.obstacles.empty()) return "";
  for (const granvof::Box& box : gridded.obstacles) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(gridded.dimensions); ++d) {
      for (const double x : {box.lower[d], box.upper[d]}) {
        const double faces = x / gridded.grid.spacing[d];
        if (std::abs(faces - std::round(faces)) > 1e-6)
          return fmt::format(
              "an obstacle's face at {} = {} m does not lie on one of the fluid cells; choose "
              "reference.cell so that it does",
              "xyz"[d], x);
      }
    }
  }
  const Obstacles o = obstacles_on(gridded);
  if (touch_along_an_edge_alone(o))
    return "obstacles touch along an edge alone, allowed: ones that share faces or stand apart";
  const bool open = gridded.sides[granvof::top].kind == granvof::SideKind::open;
  const int gate =
      gridded.gate ? static_cast<int>(std::lround(gridded.gate->position / gridded.grid.spacing[0])) : -1;
  const Parts parts(o, gate);
  if (open ? parts.below_the_top() > 0 : parts.count() > (gridded.gate ? 2 : 1))
    return "obstacles shut a part of the tank off, allowed: ones that leave a way for the fluid from all of "
           "it";
  return "";
}

bool inside_an_obstacle(const Scene& scene, const double* point) {
  return std::any_of(scene.obstacles.begin(), scene.obstacles.end(), [&](const granvof::Box& box) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimensions); ++d)
      if (point[d] < box.lower[d] || point[d] >= box.upper[d]) return false;
    return true;
  });
}

}  // namespace demvof
