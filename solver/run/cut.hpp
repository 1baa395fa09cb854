// Whether a scene can be run by several processes.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// Throws CaseError where so many processes cannot share the tank: it has too few rows.
void check_cut(const Scene& scene, int processes);

}  // namespace granvof
