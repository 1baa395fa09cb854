// A wall: closed to both phases; each sticks to it or slips along it, grains with friction too, or by
// collisions with bumps.
#include <numbers>

#include "solver/grid/sides/side_rule.hpp"

namespace granvof {
namespace {

Tangent tangent_of(WallKind kind, const Vec3& velocity) {
  Tangent tangent;
  if (kind != WallKind::no_slip && kind != WallKind::bumpy)
    return tangent;  // the stress of a Coulomb wall is the friction operator's
  tangent.share = -1.0;
  for (int c = 0; c < 3; ++c) tangent.shift[c] = 2.0 * velocity[c];
  return tangent;
}

}  // namespace

SideRule wall_rule(const Side& side) {
  SideRule rule;
  rule.fluid = tangent_of(side.fluid.kind, side.velocity);
  rule.grains = tangent_of(side.solid.kind, side.velocity);
  rule.velocity = side.velocity;
  if (side.solid.kind == WallKind::bumpy)
    rule.bumps = {side.solid.bumpiness * std::numbers::pi / 180.0, side.solid.restitution};
  else if (side.solid.kind != WallKind::no_slip)
    rule.friction = side.solid.kind == WallKind::coulomb ? side.solid.friction : 0.0;
  return rule;
}

}  // namespace granvof
