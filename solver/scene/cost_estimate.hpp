// What a run of a scene will take, before it is made: steps and CPU time, from the scene alone.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

struct CostEstimate {
  double cells;         // of the grid
  double steps;         // > 0
  double core_seconds;  // of the time loop on one core [s]
};

// Fastest motion V = sqrt(g H), H the height of the bed, else of the liquid, for six times sqrt(H / g); then
// a quarter of it; steps by the Courant number, dt_max and the gate. Of the 128 runs of make verify with a
// version of 2026 nine in ten took between half and 1.3 times these steps; where all motion is slow (a
// suspension that settles in a viscous liquid) far fewer. Steps of explicit contacts are not estimated.
CostEstimate estimate_cost(const Scene& scene);

}  // namespace granvof
