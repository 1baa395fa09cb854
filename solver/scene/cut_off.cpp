#include "solver/scene/cut_off.hpp"

#include <cmath>
#include <vector>

#include "solver/scene/box_cells.hpp"

namespace granvof {
namespace {

using Place = std::array<int, 3>;

class Rooms {
 public:
  explicit Rooms(const Scene& scene) : scene_(scene), n_(scene.grid.cells), closed_(count(), false) {
    for (const Box& box : scene.obstacles) {
      const BoxCells cells = cells_of(box, scene.grid.spacing, scene.dimensions);
      for_each(cells.lower, cells.upper, [&](const Place& at) { closed_[index(at)] = true; });
    }
  }

  // Closes the room of every free cell on a side, and says whether one of them had no way out.
  bool any_without_a_way_out(int side) {
    Place lower{0, 0, 0}, upper = n_;
    const int d = side / 2;
    (side % 2 == 1 ? lower[d] : upper[d]) = side % 2 == 1 ? n_[d] - 1 : 1;
    bool shut_in = false;
    for_each(lower, upper, [&](const Place& at) {
      if (!closed_[index(at)] && !fill(at)) shut_in = true;
    });
    return shut_in;
  }

 private:
  std::size_t count() const { return static_cast<std::size_t>(n_[0]) * n_[1] * n_[2]; }
  std::size_t index(const Place& at) const {
    return (static_cast<std::size_t>(at[2]) * n_[1] + at[1]) * n_[0] + at[0];
  }
  template <typename Visit>
  static void for_each(const Place& lower, const Place& upper, Visit&& visit) {
    for (int k = lower[2]; k < upper[2]; ++k)
      for (int j = lower[1]; j < upper[1]; ++j)
        for (int i = lower[0]; i < upper[0]; ++i) visit(Place{i, j, k});
  }

  // Closes the room of a free cell; whether it touches a side at which something leaves.
  bool fill(const Place& first) {
    bool way_out = false;
    std::vector<Place> left{first};
    closed_[index(first)] = true;
    while (!left.empty()) {
      const Place at = left.back();
      left.pop_back();
      for (int side = 0; side < 2 * scene_.dimensions; ++side) {
        const int d = side / 2;
        Place next = at;
        next[d] += side % 2 == 1 ? 1 : -1;
        if (d == 0 && std::max(at[0], next[0]) == gate_) continue;
        if (next[d] < 0 || next[d] == n_[d]) {
          const SideKind kind = scene_.sides[side].kind;
          way_out = way_out || kind == SideKind::outlet || kind == SideKind::open;
          if (kind != SideKind::periodic) continue;
          next[d] = next[d] < 0 ? n_[d] - 1 : 0;
        }
        if (closed_[index(next)]) continue;
        closed_[index(next)] = true;
        left.push_back(next);
      }
    }
    return way_out;
  }

  const Scene& scene_;
  Place n_;
  int gate_ =
      scene_.gate ? static_cast<int>(std::lround(scene_.gate->position / scene_.grid.spacing[0])) : -1;
  std::vector<bool> closed_;
};

}  // namespace

bool is_cut_off(const Scene& scene, int inlet) {
  return Rooms(scene).any_without_a_way_out(inlet);
}

}  // namespace granvof
