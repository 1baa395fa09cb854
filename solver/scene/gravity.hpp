// Gravity in the tank's own directions.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/scene/scene.hpp"

namespace granvof {

// g [m/s2] of a tank whose floor is inclined by tank.inclination, down towards +x: |g| (sin, -cos, 0).
inline Vec3 gravity_of(const Scene& scene) {
  const double angle = scene.inclination * std::numbers::pi / 180.0;
  return {scene.gravity * std::sin(angle), -scene.gravity * std::cos(angle), 0.0};
}

// The part of g that has a potential in the tank: along a periodic direction there is none, what falls comes
// in again at the other end.
inline Vec3 confined_gravity(const Scene& scene) {
  Vec3 g = gravity_of(scene);
  for (int d = 0; d < 3; ++d)
    if (scene.sides[2 * d].kind == SideKind::periodic) g[d] = 0.0;
  return g;
}

// The gradient of pressure [Pa/m] along periodic directions that the gas outside an open top has at rest. The
// tank's own pressure repeats itself there, so that this one works on both phases beside it.
inline Vec3 gradient_outside(const Scene& scene) {
  Vec3 gradient{};
  if (scene.sides[top].kind != SideKind::open) return gradient;
  const Vec3 g = gravity_of(scene), confined = confined_gravity(scene);
  for (int d = 0; d < 3; ++d) gradient[d] = scene.gas.density * (g[d] - confined[d]);
  return gradient;
}

// -g_y: what presses on the floor [m/s2], >= 0.
inline double normal_gravity(const Scene& scene) {
  return -gravity_of(scene)[1];
}

}  // namespace granvof
