#include "solver/run/cut.hpp"

#include <fmt/format.h>

#include "solver/grid/grid.hpp"
#include "solver/grid/slabs.hpp"
#include "solver/scene/case_error.hpp"

namespace granvof {

void check_cut(const Scene& scene, int processes) {
  if (processes == 1) return;
  const auto refuse = [&](const std::string& what) {
    throw CaseError(fmt::format("{}: {}", scene.file.string(), what));
  };
  if (!scene.obstacles.empty())
    refuse(fmt::format(
        "obstacle: got {} of them and {} processes, allowed: one process where there are obstacles",
        scene.obstacles.size(), processes));
  for (int side = 0; side < 6; ++side)
    if (side != top && side_rule(scene, side).is_open())
      refuse(
          fmt::format("walls: got an inlet or an outlet and {} processes, allowed: one process unless the "
                      "open top is all that the tank's sides let through",
                      processes));
  const int most = most_slabs(scene.grid.cells, scene.dimensions);
  if (processes > most)
    refuse(fmt::format(
        "grid.cells: got {} along {} and {} processes, allowed: at most {} processes, {} rows "
        "for each",
        scene.grid.cells[direction_of_cut(scene.grid.cells, scene.dimensions)],
        "xyz"[direction_of_cut(scene.grid.cells, scene.dimensions)], processes, most, least_rows_of_a_slab));
}

}  // namespace granvof
