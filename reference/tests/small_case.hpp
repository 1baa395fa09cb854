// A case of a few hundred grains, for tests of demvof from the case file on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/load_scene.hpp"

namespace demvof::test {

inline constexpr std::string_view small_case = R"([scene]
name = "small"
dimensions = 2
[tank]
size = [0.03, 0.02]
[grid]
dx = 0.0025
[walls]
top = "open"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.015
[solid]
density = 2500
diameter = 0.8e-3
restitution = 0.9
friction = 0.4
[bed]
length = 0.01
height = 0.006
solid_fraction = 0.57
[time]
end = 0.01
[output]
series_interval = 0.002
[reference]
cell = 0.0025
slice_depth = 0.004
fluid_dt = 2e-4
)";

inline granvof::Scene small(const std::vector<std::string>& overrides = {}) {
  return granvof::parse_scene(small_case, "small.toml", overrides);
}

}  // namespace demvof::test
