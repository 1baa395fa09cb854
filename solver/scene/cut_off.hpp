// Whether obstacles, or the gate as it stands at the start, shut an inlet in.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// Whether some of what comes in at an inlet finds no way, past the obstacles and the gate and through
// periodic ends, to a side at which it leaves: what comes in then has no room, and no pressure makes it any.
// Needs the scene's grid, sides, gate and obstacles, these of whole cells.
bool is_cut_off(const Scene& scene, int inlet);

}  // namespace granvof
