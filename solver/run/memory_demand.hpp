// Memory that a run needs, against what there is: a run that cannot fit is refused before it writes.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// [bytes] of a run at its largest, output included; of the lowest of so many processes that share its tank,
// >= 1: its slab, and the whole tank's state that output is made of.
double memory_demand(const Scene& scene, int processes = 1);

// [bytes] that this process may have: of the machine, of its control group and of its own limit the least.
double memory_limit();

// Throws CaseError that names the grid's spacing where the demand is above the limit. Of processes that share
// a machine each looks at its own demand alone.
void check_memory(const Scene& scene, int processes = 1);

}  // namespace granvof
