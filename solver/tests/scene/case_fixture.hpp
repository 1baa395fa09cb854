// A small complete case, whole enough that one change at a time shows one error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/load_scene.hpp"

namespace granvof::test {

inline constexpr std::string_view small_case = R"([scene]
name = "small"
dimensions = 2
[tank]
size = [0.4, 0.12]
[grid]
dx = 0.01
[walls]
top = "open"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.07
[solid]
density = 2500
diameter = 0.8e-3
friction = 0.4
[bed]
length = 0.1
height = 0.05
solid_fraction = 0.57
[gate]
speed = 1.0
[time]
end = 10
unit = "column"
[output]
field_times = [0, 1, 5]
[reference]
cell = 0.01
slice_depth = 0.004
[model]
preset = "paper"
)";

inline Scene small(std::vector<std::string> overrides = {}) {
  return parse_scene(small_case, "small.toml", overrides);
}

// The message of the CaseError that `load` throws; empty where it throws none.
template <typename Load>
std::string refusal(Load&& load) {
  try {
    load();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

inline std::string refusal_of(std::string_view text, std::vector<std::string> overrides = {}) {
  return refusal([&] { parse_scene(text, "small.toml", overrides); });
}

}  // namespace granvof::test
