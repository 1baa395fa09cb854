// A two-dimensional tank of gas and liquid without beads, open at the top.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

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

// Cells of liquid right of column 10, where a gate may stand.
inline double right_of_gate(const FluidSettings& s, const Fluid& fluid) {
  const auto nx = static_cast<std::size_t>(s.cells[0]), cells = nx * static_cast<std::size_t>(s.cells[1]);
  double sum = 0.0;
  for (std::size_t c = 0; c < cells; ++c) sum += c % nx >= 10 ? fluid.view().alpha[c] : 0.0;
  return sum;
}

// Water on the left of a closed gate stays there.
inline void expect_that_a_gate_blocks(const FluidSettings& s) {
  const auto rows = static_cast<std::size_t>(s.cells[1]), cells = rows * static_cast<std::size_t>(s.cells[0]);
  const BeadLoad load = no_beads(cells);
  Fluid closed(s, filled_to(s, 0.03, 10), std::vector<double>(cells, 1.0));
  closed.set_gate(10, std::vector<double>(rows, 0.0));
  for (int n = 0; n < 50; ++n) closed.step(2e-4, load);
  EXPECT_LT(right_of_gate(s, closed), 1e-9);
  EXPECT_LT(closed.largest_speed(), 1e-3);
}

}  // namespace demvof::test
