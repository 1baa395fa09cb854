#include "solver/grid/sides/side_rule.hpp"

namespace granvof {

SideRule side_rule(const Scene& scene, int side) {
  const Side& given = scene.sides[side];
  switch (given.kind) {
    case SideKind::wall:
      return wall_rule(given);
    case SideKind::open:
      return open_top_rule(scene);
    case SideKind::periodic:
      return periodic_rule();
    case SideKind::inlet:
      return inlet_rule(given.inflow);
    case SideKind::outlet:
      return outlet_rule(scene, side);
  }
  return {};
}

}  // namespace granvof
