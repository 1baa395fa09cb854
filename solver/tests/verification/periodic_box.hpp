// A square without sides: the scene of the tests on smooth flows.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {

inline constexpr double side = 0.1;                        // of the periodic box [m]
inline const double wave = 2.0 * std::numbers::pi / side;  // [1/m]

// Grains of 0.3 in a liquid of 0.05 Pa s, no gravity; `extra` overrides anything.
inline Scene periodic_box(int cells, double dt, const std::vector<std::string>& extra) {
  std::vector<std::string> overrides{fmt::format("grid.dx={}", side / cells),
                                     fmt::format("numerics.dt_max={}", dt)};
  overrides.insert(overrides.end(), extra.begin(), extra.end());
  return parse_scene(R"(
[scene]
name = "box"
[tank]
size = [0.1, 0.1]
gravity = 0
[grid]
dx = 0.1
[walls]
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 0.05
level = 0.1
[solid]
density = 2500
diameter = 2e-3
friction = 0.4
[bed]
length = 0.1
height = 0.1
solid_fraction = 0.3
[model]
preset = "paper"
les = false
granular_temperature = "off"
[time]
end = 100
[numerics]
volume_tolerance = 1e-9
)",
                     "box", overrides);
}

}  // namespace granvof::test
