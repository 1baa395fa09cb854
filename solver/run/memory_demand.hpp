// Memory that a run needs, against what there is: a run that cannot fit is refused before it writes.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// [bytes] of a run at its largest, output included.
double memory_demand(const Scene& scene);

// [bytes] that this process may have: of the machine, of its control group and of its own limit the least.
double memory_limit();

// Throws CaseError that names the grid's spacing where the demand is above the limit.
void check_memory(const Scene& scene);

}  // namespace granvof
