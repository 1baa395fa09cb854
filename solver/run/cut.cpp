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
  const int most = most_slabs(scene.grid.cells, scene.dimensions);
  if (processes > most)
    refuse(fmt::format(
        "grid.cells: got {} along {} and {} processes, allowed: at most {} processes, {} rows "
        "for each",
        scene.grid.cells[direction_of_cut(scene.grid.cells, scene.dimensions)],
        "xyz"[direction_of_cut(scene.grid.cells, scene.dimensions)], processes, most, least_rows_of_a_slab));
}

}  // namespace granvof
