// An outlet: the fluid passes at the pressure that a fluid at rest beyond it has, grains leave at the speed
// at which they arrive and none come in.
#include <algorithm>

#include "solver/grid/sides/side_rule.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {

SideRule outlet_rule(const Scene& scene, int side) {
  SideRule rule;
  rule.passes_fluid = rule.passes_grains = true;
  rule.friction = 0.0;
  rule.bears_grains = false;
  const Outflow outflow = scene.sides[side].outflow;
  const double height = scene.tank[1], gas = scene.gas.density, liquid = scene.liquid.density;
  const double normal = normal_gravity(scene), middle = 0.5 * scene.tank[0];
  // Where the side lies along x the weight of an inclined tank counts from its middle, as on the open top.
  const double along = side / 2 == 0 ? 0.0 : confined_gravity(scene)[0];
  // What flows back is what is beyond.
  if (outflow.level <= 0.0) {
    rule.liquid_share = 0.0;
  } else if (outflow.level >= height) {
    rule.liquid_share = 1.0;
  } else {
    const bool upright = side / 2 != 1;
    rule.liquid_that_flows_back = [=](const Vec3& place, double cell) {
      const double above = outflow.level - place[1];
      return upright ? std::clamp(above / cell + 0.5, 0.0, 1.0) : (above > 0.0 ? 1.0 : 0.0);
    };
  }
  rule.pressure = [=](const Vec3& place) {
    const double of_liquid = std::max(outflow.level - place[1], 0.0);
    const double of_gas = height - std::max(outflow.level, place[1]);
    const double rho = place[1] < outflow.level ? liquid : gas;
    return outflow.pressure + normal * (gas * of_gas + liquid * of_liquid) +
           rho * along * (place[0] - middle);
  };
  return rule;
}

}  // namespace granvof
