// The open top: fluid passes at P_c = 0, gas flows in, grains do not pass and do not rest on it.
#include "solver/grid/sides/side_rule.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {

SideRule open_top_rule(const Scene& scene) {
  SideRule rule;
  rule.passes_fluid = true;
  rule.solid_fraction = 0.0;
  rule.liquid_share = 0.0;
  rule.friction = 0.0;
  rule.bears_grains = false;
  // Over an inclined tank the gas outside is at rest too: zero at the middle of the top, as the mean over a
  // lid is (pressure_level.hpp).
  const double weight = scene.gas.density * confined_gravity(scene)[0];
  if (weight != 0.0)
    rule.pressure = [weight, middle = 0.5 * scene.tank[0]](const Vec3& place) {
      return weight * (place[0] - middle);
    };
  return rule;
}

}  // namespace granvof
