// A two-dimensional tank of gas and liquid without beads, open at the top.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "reference/demvof/fluid/fluid.hpp"

namespace demvof::test {

inline FluidSettings fluid_tank(int nx, int ny) {
  FluidSettings s;
  s.cells = {{nx, ny, 1}};
  s.spacing = {{2.5e-3, 2.5e-3, 4e-3}};
  s.sides = {{FluidSide::no_slip, FluidSide::no_slip, FluidSide::no_slip, FluidSide::open, FluidSide::empty,
              FluidSide::empty}};
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  return s;
}

inline BeadLoad no_beads(std::size_t cells) {
  BeadLoad load;
  load.void_fraction.assign(cells, 1.0);
  load.drag_coefficient.assign(cells, 0.0);
  for (auto& component : load.force) component.assign(cells, 0.0);
  return load;
}

inline std::vector<double> filled_to(const FluidSettings& s, double level, int columns) {
  std::vector<double> alpha;
  for (int j = 0; j < s.cells[1]; ++j)
    for (int i = 0; i < s.cells[0]; ++i)
      alpha.push_back(i < columns && j * s.spacing[1] < level - 1e-9 ? 1.0 : 0.0);
  return alpha;
}

}  // namespace demvof::test
