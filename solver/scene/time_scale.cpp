#include "solver/scene/time_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granvof {

double fall_time(const Scene& scene) {
  if (scene.gravity == 0.0) return std::numeric_limits<double>::infinity();
  double height = scene.tank[1];
  if (scene.bed) {
    height = scene.bed->box.upper[1] - scene.bed->box.lower[1];
  } else if (!scene.liquid_boxes.empty()) {
    height = 0.0;
    for (const Box& box : scene.liquid_boxes) height = std::max(height, box.upper[1] - box.lower[1]);
  }
  return std::sqrt(height / scene.gravity);
}

double time_scale(const Scene& scene) {
  const double fall = fall_time(scene);
  if (!scene.bed || scene.liquid_boxes.empty()) return fall;
  const double excess = std::fabs(scene.solid.density - scene.liquid.density);
  const double d = scene.solid.diameter;
  const double stokes = excess * scene.gravity * d * d / (18.0 * scene.liquid.viscosity);
  return std::max(fall, scene.grid.spacing[1] / stokes);
}

}  // namespace granvof
