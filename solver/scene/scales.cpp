#include "solver/scene/scales.hpp"

#include <algorithm>
#include <cmath>

namespace granvof {
namespace {

// Grains as heavy as the fluid bear nothing: their load counts as at least this share of their weight.
constexpr double least_excess = 1e-3;

double length_of(const Scene& scene) {
  if (scene.bed) return scene.bed->box.upper[1] - scene.bed->box.lower[1];
  double deepest = 0.0;
  for (const Box& box : scene.liquid_boxes) deepest = std::max(deepest, box.upper[1] - box.lower[1]);
  return deepest > 0.0 ? deepest : scene.tank[1];
}

double fastest_wall(const Scene& scene) {
  double square = 0.0;
  for (const Side& side : scene.sides) {
    double of_side = 0.0;
    for (const double v : side.velocity) of_side += v * v;
    square = std::max({square, of_side, side.inflow.speed * side.inflow.speed});
  }
  return std::sqrt(square);
}

// |rho_s - rho| in the fluid of the scene whose density is nearest to the grains' [kg/m3].
double least_excess_density(const Scene& scene) {
  const double rho_s = scene.solid.density;
  double excess = std::fabs(rho_s - scene.gas.density);
  if (!scene.liquid_boxes.empty()) excess = std::min(excess, std::fabs(rho_s - scene.liquid.density));
  return std::max(excess, least_excess * rho_s);
}

}  // namespace

Scales scales_of(const Scene& scene) {
  const double length = length_of(scene), wall = fastest_wall(scene);
  const double falling = std::sqrt(scene.gravity * length);
  double velocity = std::max(falling, wall), inertial = wall;
  if (velocity == 0.0) velocity = inertial = length / scene.times.end;
  // A case without a bed has grains only where a caller puts them; without [solid] their density is a
  // stand-in.
  const double rho = scene.bed ? scene.solid.density : scene.liquid.density;
  const double weight = (scene.bed ? least_excess_density(scene) : rho) * scene.gravity * length;
  const double volume = scene.tank[0] * scene.tank[1] * scene.tank[2];
  return {length, velocity, std::max(weight, rho * inertial * inertial),
          0.5 * scene.liquid.density * velocity * velocity * volume};
}

double energy_of_bed(const Scene& scene) {
  if (!scene.bed) return 0.0;
  Vec3 size;
  for (int d = 0; d < 3; ++d) size[d] = scene.bed->box.upper[d] - scene.bed->box.lower[d];
  const double load = least_excess_density(scene) * scene.gravity * size[1];
  return 0.5 * scene.bed->solid_fraction * load * size[0] * size[1] * size[2];
}

}  // namespace granvof
