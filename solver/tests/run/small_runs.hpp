// Small scenes, a run of them into a directory of its own, and a run step by step without any output.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/run/run_case.hpp"
#include "solver/run/snapshot.hpp"
#include "solver/run/step_control.hpp"
#include "solver/run/time_step.hpp"
#include "solver/scene/load_scene.hpp"

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
[time]
end = 0.1
[output]
series_interval = 0.01
field_times = [0, 0.05]
)";

inline Scene column_scene(const std::vector<std::string>& overrides = {}) {
  return parse_scene(column_case, "column.toml", overrides);
}

inline int run_into(const std::filesystem::path& out, const Scene& scene, bool resume = false) {
  RunOptions options;
  options.out = out;
  options.command = "test";
  options.resume = resume;
  options.progress = false;
  return run_case(scene, options);
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

// A scene advanced step by step, as run_case does it, all in memory.
class Steps {
 public:
  explicit Steps(Scene given)
      : scene(std::move(given)),
        grid(scene),
        boundary(grid, scene, communicator_),
        now(initial_state(grid, scene, boundary)),
        next_(grid),
        step_(grid, scene, boundary, communicator_),
        control_(grid, scene) {}
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;
  Steps(Steps&&) = delete;
  Steps& operator=(Steps&&) = delete;
  ~Steps() = default;

  // One accepted step, shorter after refusals. Fails the test if none below 1e-7 s is taken.
  void advance(double longest = 1.0) {
    double dt = std::min(control_.next(now, viscosity_), longest);
    for (;;) {
      const StepReport report = step_.advance(now, dt, next_);
      if (report.accepted) {
        viscosity_ = report.kinematic_viscosity;
        break;
      }
      ++refused;
      dt = control_.after_refusal(dt);
      ASSERT_GT(dt, 1e-7) << report.refused_because;
    }
    std::swap(now, next_);
    control_.accepted(dt);
    ++steps;
  }
  void until(double time) {
    while (now.time < time - 1e-12) {
      advance(time - now.time);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
  // Largest |value| of component d of a velocity on its faces.
  double fastest(const FaceField& u) const {
    double most = 0.0;
    for (int d = 0; d < grid.dim; ++d) {
      const double* v = u[d].data();
      most = std::fmax(most, max_over(grid.cells, grid.fluid_faces(d), 0.0,
                                      [=](std::ptrdiff_t c) { return std::fabs(v[c]); }));
    }
    return most;
  }

  Scene scene;

 private:
  SerialCommunicator communicator_;

 public:
  Grid grid;
  Boundary boundary;
  State now;
  int steps = 0, refused = 0;

 private:
  State next_;
  TimeStep step_;
  StepControl control_;
  double viscosity_ = 0.0;
};

}  // namespace granvof::test
