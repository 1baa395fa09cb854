// A scene run step by step in memory by the program's own time loop, its state open to be set and to be
// measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "solver/run/snapshot.hpp"
#include "solver/run/time_loop.hpp"

namespace granvof::test {

class Simulation {
 public:
  explicit Simulation(Scene given) : scene(std::move(given)), loop_(scene) {}
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  Simulation(Simulation&&) = delete;
  Simulation& operator=(Simulation&&) = delete;
  ~Simulation() = default;

  // One accepted step of at most `longest` [s]. Fails the test where the step collapses.
  void advance(double longest = std::numeric_limits<double>::infinity()) {
    const auto stuck = loop_.advance(longest, extra ? &*extra : nullptr);
    ASSERT_FALSE(stuck) << stuck->reason;
  }
  // To `time` [s] exactly, observe() after every step.
  template <typename Observe>
  void until(double time, Observe&& observe) {
    while (now.time < time * (1.0 - 1e-12)) {
      const double left = time - now.time, dt = std::min(loop_.next_dt(), left);
      advance(left / std::ceil(left / dt * (1.0 - 1e-9)));
      if (::testing::Test::HasFatalFailure()) return;
      observe();
    }
  }
  void until(double time) {
    until(time, [] {});
  }
  // The state before the last step.
  const State& before() const { return loop_.before(); }

  std::map<std::string, double> cost() const { return loop_.cost(); }

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
  TimeLoop loop_;

 public:
  const Grid& grid = loop_.grid();
  const Boundary& boundary = loop_.boundary();
  State& now = loop_.now();
  const StepReport& last = loop_.last_step();
  const std::int64_t &steps = loop_.counters().steps, &refused = loop_.counters().refused_steps;
  std::optional<BodyAcceleration> extra;  // sources of a manufactured solution, where set
};

}  // namespace granvof::test
