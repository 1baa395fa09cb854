// One of a periodic pair: there is no side, what leaves here comes in at the other end.
#include "solver/grid/sides/side_rule.hpp"

namespace granvof {

SideRule periodic_rule() {
  SideRule rule;
  rule.joined = true;
  rule.friction = 0.0;
  rule.bears_grains = false;
  return rule;
}

}  // namespace granvof
