// Friction of a flowing layer of beads on a plane wall.
#pragma once

#include "reference/demvof/bulk_friction/layer.hpp"
#include "reference/demvof/element/measured.hpp"

namespace demvof {

// Shear stress over load at a plane floor on which a layer slides, from the momentum of the whole layer, as
// on a chute: mean over the windows in which it slips. Beads may roll on the wall, so that it is less than
// the friction of their contacts with it. Throws std::runtime_error when a bead is lost or the layer does not
// slide.
Measured wall_friction(LayerSettings settings);

}  // namespace demvof
