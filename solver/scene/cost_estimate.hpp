// What a run of a scene will take, before it is made: steps and CPU time, from the scene alone.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

struct CostEstimate {
  double cells;         // of the grid
  double fastest;       // motion that is expected [m/s]
  double steps;         // > 0
  double core_seconds;  // of the time loop on one core [s]
};

// Steps by the Courant number, dt_max and the gate, from the fastest motion at each time: those of
// fast_motions.hpp. Of 68 runs, 28 shipped and 40 falls, jets, dam breaks, slides and layers at rest,
// 66 took between half and twice these steps, the others down to a third.
// Steps of explicit contacts are not estimated.
CostEstimate estimate_cost(const Scene& scene);

}  // namespace granvof
