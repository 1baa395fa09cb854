// An inlet: both phases come in at a given speed along its normal, with given fractions. Without grains in
// what comes in it is a closed wall to the grains of the tank, on which they slip and may rest.
#include "solver/grid/sides/side_rule.hpp"

namespace granvof {

SideRule inlet_rule(const Inflow& inflow) {
  SideRule rule;
  const bool grains = inflow.solid_fraction > 0.0;
  rule.inflow_of_fluid = inflow.speed;
  rule.inflow_of_grains = grains ? inflow.speed : 0.0;
  rule.solid_fraction = inflow.solid_fraction;
  rule.liquid_share = inflow.liquid_share;
  rule.fluid.share = 0.0;  // beyond it nothing moves along the side
  rule.grains.share = grains ? 0.0 : 1.0;
  rule.friction = 0.0;
  rule.bears_grains = !grains;
  return rule;
}

}  // namespace granvof
