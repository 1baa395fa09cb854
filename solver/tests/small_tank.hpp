// A small case for tests, as text that they add to.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "solver/scene/load_scene.hpp"

namespace granvof::test {

// A tank of cells of 5 mm, with water up to `level`, air above and glass beads for whoever sets a bed.
// `tank`: the lines of [tank]; `tables`: those of the case beside these.
inline Scene small_tank(const std::string& name, std::string_view tank, double level, std::string_view tables,
                        const std::vector<std::string>& overrides) {
  return parse_scene(fmt::format(R"([scene]
name = "{}"
[tank]
{}
[grid]
dx = 0.005
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = {}
[solid]
density = 2500
diameter = 0.8e-3
friction = 0.4
[time]
end = 100
{})",
                                 name, tank, level, tables),
                     name, overrides);
}

}  // namespace granvof::test
