// What the fluid does to the beads.
#pragma once

#include <cstddef>
#include <vector>

namespace demvof {

// Force of the fluid on a mobile bead during the next run: force + coefficient (velocity - u_bead), the
// drag part evaluated anew every DEM step.
struct FluidLoad {
  std::vector<double> coefficient;  // one a bead [kg/s]
  std::vector<double> velocity;     // three a bead: fluid at the bead [m/s]
  std::vector<double> force;        // three a bead [N]
  void resize(std::size_t beads);
};

}  // namespace demvof
