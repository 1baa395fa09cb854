// A two-dimensional tank of water with beads, for tests of beads and fluid together.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "reference/demvof/coupling/coupled_run.hpp"

namespace demvof::test {

struct TankSetup {
  FluidSettings fluid;
  BeadSettings beads;
  std::size_t cells() const {
    return static_cast<std::size_t>(fluid.cells[0]) * static_cast<std::size_t>(fluid.cells[1]);
  }
};

// A two-dimensional tank of water without a surface, closed or open at the top.
inline TankSetup tank(int nx, int ny, double cell, double depth, FluidSide top) {
  TankSetup s;
  s.fluid.cells = {{nx, ny, 1}};
  s.fluid.spacing = {{cell, cell, depth}};
  s.fluid.sides = {
      {FluidSide::slip, FluidSide::slip, FluidSide::slip, top, FluidSide::empty, FluidSide::empty}};
  s.fluid.large_eddy = false;
  s.fluid.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  s.beads.tank = {nx * cell, ny * cell, depth};
  s.beads.diameter = 0.8e-3;
  s.beads.density = 2500.0;
  s.beads.scratch_folder = s.fluid.scratch_folder;
  return s;
}

// Closes cells [lower, upper) to both.
inline void put_obstacle(TankSetup& s, std::array<int, 2> lower, std::array<int, 2> upper) {
  s.fluid.obstacles.resize(s.cells(), 0);
  for (int j = lower[1]; j < upper[1]; ++j)
    for (int i = lower[0]; i < upper[0]; ++i)
      s.fluid.obstacles[static_cast<std::size_t>(j * s.fluid.cells[0] + i)] = 1;
  s.beads.obstacles = {s.fluid.cells, s.fluid.spacing, s.fluid.obstacles};
}

inline CoupledRun start(const TankSetup& s, const std::vector<double>& position, double fluid_dt = 2e-4,
                        bool predict_pressure = false) {
  BeadState beads;
  beads.position = position;
  CouplingSettings coupling;
  coupling.fluid_dt = fluid_dt;
  coupling.predict_pressure = predict_pressure;
  return {coupling, s.beads, beads, {}, s.fluid, std::vector<double>(s.cells(), 1.0)};
}

}  // namespace demvof::test
