// A scene run step by step in memory, with its state open to be set and to be measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "solver/run/snapshot.hpp"
#include "solver/run/step_control.hpp"
#include "solver/run/time_step.hpp"

namespace granvof::test {

class Simulation {
 public:
  explicit Simulation(Scene given)
      : scene(std::move(given)),
        grid(scene),
        boundary(grid, communicator_),
        now(initial_state(grid, scene, boundary)),
        next_(grid),
        step_(grid, scene, boundary, communicator_),
        control_(grid, scene) {}
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation(Simulation&&) = delete;
  Simulation& operator=(Simulation&&) = delete;
  ~Simulation() = default;

  // One accepted step of at most `longest` [s], as run_case takes it. Fails the test where the step
  // collapses.
  void advance(double longest = std::numeric_limits<double>::infinity()) {
    double dt = std::min(control_.next(now), longest);
    for (;;) {
      last = step_.advance(now, dt, next_, extra ? &*extra : nullptr);
      if (last.accepted) break;
      ++refused;
      dt = control_.after_refusal(dt);
      ASSERT_GT(dt, scene.numerics.dt_min) << "t = " << now.time << " s: " << last.refused_because;
    }
    std::swap(now, next_);
    control_.accepted(dt);
    ++steps;
  }
  // To `time` [s] exactly, observe() after every step.
  template <typename Observe>
  void until(double time, Observe&& observe) {
    while (now.time < time * (1.0 - 1e-12)) {
      const double left = time - now.time, dt = std::min(control_.next(now), left);
      advance(left / std::ceil(left / dt * (1.0 - 1e-9)));
      if (::testing::Test::HasFatalFailure()) return;
      observe();
    }
  }
  void until(double time) {
    until(time, [] {});
  }
  // The state before the last step.
  const State& before() const { return next_; }

  // After the state was set by hand.
  void fill_ghosts() { now.fill_ghosts(boundary); }

  std::ptrdiff_t cell(int i, int j) const { return grid.cells.index(i, j, 0); }
  // value(x, y) at every cell centre.
  template <typename Value>
  void set(Field& f, Value&& value) const {
    for (int j = 0; j < grid.cells.n[1]; ++j)
      for (int i = 0; i < grid.cells.n[0]; ++i)
        f[cell(i, j)] = value((i + 0.5) * grid.h[0], (j + 0.5) * grid.h[1]);
  }
  // value(x, y) on every face of direction d that is not on a closed side.
  template <typename Value>
  void set_faces(Field& f, int d, Value&& value) const {
    const Range r = grid.inner_faces(d);
    for (int j = r.lower[1]; j < r.upper[1]; ++j)
      for (int i = r.lower[0]; i < r.upper[0]; ++i)
        f[cell(i, j)] = value((d == 0 ? i : i + 0.5) * grid.h[0], (d == 1 ? j : j + 0.5) * grid.h[1]);
  }
  // Largest |component| of a velocity [m/s].
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
  StepReport last;
  int steps = 0, refused = 0;
  std::optional<BodyAcceleration> extra;  // sources of a manufactured solution, where set

 private:
  State next_;
  TimeStep step_;
  StepControl control_;
};

}  // namespace granvof::test
