#include "solver/scene/cost_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double times_in_motion = 6.0;  // in sqrt(H / g): a collapse has come down by then
constexpr double late_speed = 0.25;      // of V
constexpr double gate_rows = 0.5;        // rows of cells the gate passes in a step

// CPU time of a step on one core of an AMD EPYC server of 2021: 2.7 ms with 480 cells, 13 ms with 7680. A
// cost has no scale of the scene to be a share of.
constexpr double seconds_per_step = 2.0e-3;
constexpr double seconds_per_cell_step = 1.45e-6;

}  // namespace

CostEstimate estimate_cost(const Scene& scene) {
  const auto& n = scene.grid.cells;
  const double cells = static_cast<double>(n[0]) * n[1] * n[2];
  const Scales scales = scales_of(scene);
  double shortest = scene.grid.spacing[0];
  for (int d = 1; d < scene.dimensions; ++d) shortest = std::min(shortest, scene.grid.spacing[d]);
  const auto step_at = [&](double speed) {
    return std::min(scene.numerics.dt_max, scene.numerics.cfl * shortest / speed);
  };
  const double all = scene.times.end + scene.times.hold;
  const double moving = std::min(all, times_in_motion * scales.time());
  const double fast = step_at(scales.velocity);
  double steps = moving / fast + (all - moving) / step_at(late_speed * scales.velocity);
  if (scene.gate) {
    const double passing = std::min(scene.times.end, scene.tank[1] / scene.gate->speed);
    const double gate_step = gate_rows * scene.grid.spacing[1] / scene.gate->speed;
    steps += std::max(0.0, passing / gate_step - passing / fast);
  }
  steps = std::max(steps, 1.0);
  return {cells, steps, steps * (seconds_per_step + seconds_per_cell_step * cells)};
}

}  // namespace granvof
