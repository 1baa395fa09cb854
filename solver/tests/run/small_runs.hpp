// Small scenes, and a run of them into a directory of its own.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "solver/run/run_case.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/simulation.hpp"
#include "solver/tests/small_tank.hpp"

namespace granvof::test {

// A submerged column of 3 x 4 cells behind a gate, in a tank of 16 x 8 cells.
inline constexpr std::string_view column_case = R"([scene]
name = "column"
dimensions = 2
[tank]
size = [0.16, 0.08]
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
level = 0.06
[solid]
density = 2500
diameter = 0.8e-3
friction = 0.4
[bed]
length = 0.05
height = 0.04
solid_fraction = 0.57
[gate]
speed = 1.0
[model]
preset = "paper"
[time]
end = 0.1
[output]
series_interval = 0.01
field_times = [0, 0.05]
)";

inline Scene column_scene(const std::vector<std::string>& overrides = {}) {
  return parse_scene(column_case, "column.toml", overrides);
}

inline constexpr std::string_view tight_tolerances = R"([numerics]
volume_tolerance = 1e-12
linear_tolerance = 1e-8
)";

// The same as overrides.
inline const std::vector<std::string> tightly_solved{"numerics.volume_tolerance=1e-12",
                                                     "numerics.linear_tolerance=1e-8"};

// The same tank another way: its name in a test's, and what is set for it.
struct Variant {
  std::string name;
  std::vector<std::string> overrides;
};
inline void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}
inline constexpr auto name_of = [](const auto& instance) { return instance.param.name; };

inline int run_into(const std::filesystem::path& out, const Scene& scene, bool resume = false,
                    int threads = 1) {
  RunOptions options;
  options.out = out;
  options.command = "test";
  options.resume = resume;
  options.threads = threads;
  options.progress = false;
  return run_case(scene, options);
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

}  // namespace granvof::test
