#include "solver/scene/cost_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/scene/fast_motions.hpp"
#include "solver/scene/parts.hpp"

namespace granvof {
namespace {

constexpr double gate_rows = 0.5;      // rows of cells the gate passes in a step
constexpr int parts_of_a_motion = 32;  // that its speed is taken at

// CPU time of a step on one core: between those of processors of 2021 and of 2026, which are a factor of
// three apart. A cost has no scale of the scene to be a share of.
struct StepSeconds {
  double any, cell;
};
constexpr StepSeconds with_grains{7e-4, 9e-7}, of_fluid{3e-4, 4e-7};

}  // namespace

CostEstimate estimate_cost(const Scene& scene) {
  const auto& n = scene.grid.cells;
  const double cells = static_cast<double>(n[0]) * n[1] * n[2];
  double shortest = scene.grid.spacing[0];
  for (int d = 1; d < scene.dimensions; ++d) shortest = std::min(shortest, scene.grid.spacing[d]);
  const double longest = scene.numerics.dt_max;

  const std::vector<Motion> motions = fast_motions(scene);
  const double end = scene.times.end, rises = scene.gate ? scene.tank[1] / scene.gate->speed : 0.0;
  std::vector<double> marks{0.0, end};
  if (rises < end) marks.push_back(rises);
  for (const Motion& motion : motions)
    for (const double mark : {motion.grown, motion.lasts})
      if (mark < end) marks.push_back(mark);
  std::ranges::sort(marks);

  double steps = scene.times.hold / longest, fastest = 0.0;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double part = (marks[i + 1] - marks[i]) / parts_of_a_motion;
    for (int k = 0; k < parts_of_a_motion && part > 0.0; ++k) {
      const double time = marks[i] + (k + 0.5) * part;
      double speed = 0.0, step = longest;
      for (const Motion& motion : motions) speed = std::max(speed, motion.at(time));
      fastest = std::max(fastest, speed);
      if (speed > 0.0) step = std::min(step, scene.numerics.cfl * shortest / speed);
      if (time < rises) step = std::min(step, gate_rows * scene.grid.spacing[1] / scene.gate->speed);
      steps += part / step;
    }
  }
  steps = std::max(steps, 1.0);
  const StepSeconds& seconds = has_grains(scene) ? with_grains : of_fluid;
  return {cells, fastest, steps, steps * (seconds.any + seconds.cell * cells)};
}

}  // namespace granvof
