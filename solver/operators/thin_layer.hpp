// Arrest of thin layers of grains on a rough floor.
#pragma once

#include "solver/grid/field.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// friction [-]: the coefficient at which a layer as thick as the bed of a cell comes to rest
// (closures::arrest_friction), 0 above the bed, where the lowest cell is not bed, and on a floor that is not
// no-slip. Bed is what lies on the floor or on an obstacle without a gap: cells more than half full, f_s >=
// f_s,min / 2; its thickness is their grains at f_s,min. Interior cells only.
void arrest_thin_layers(const Grid& grid, const Scene& scene, const Field& f_s, Field& friction);

}  // namespace granvof
