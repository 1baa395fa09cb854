// Packing of beads that have come to rest, loosest and densest.
#pragma once

#include "reference/demvof/bulk_friction/layer.hpp"
#include "reference/demvof/element/measured.hpp"

namespace demvof {

struct PackingAtRest {
  Measured solid_fraction;  // of the layer without its bottom and its surface [-]
  double load = 0.0;        // mean load there [Pa]
};

// Layers of `repeats` seeds (>= 2) that fall, settle under `preparation` and come to rest once more under the
// settings' law. With the friction of a column's preparation: the loosest that the run's friction bears; with
// none: the densest at random. Throws std::runtime_error when beads do not come to rest or are lost.
PackingAtRest packing_at_rest(LayerSettings settings, const ContactLaw& preparation, int repeats);

}  // namespace demvof
