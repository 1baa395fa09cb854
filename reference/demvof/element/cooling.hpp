// Restitution of a gas of beads, from its cooling.
#pragma once

#include "reference/demvof/bulk_friction/layer.hpp"
#include "reference/demvof/element/measured.hpp"

namespace demvof {

// The restitution of smooth spheres whose gas would lose as much translational energy as the beads' does,
// friction and rotation included: beads without gravity at f_s = 0.2 in a periodic box between two planes
// without friction, from a Gaussian start. In a gas of smooth spheres
//   d(Theta^(-1/2))/dt = 4 (1 - e^2) f_s g0 / (sqrt(pi) d)
// (Haff, J. Fluid Mech. 134, 1983; g0 of Carnahan & Starling, J. Chem. Phys. 51, 1969); taken from the line
// through Theta^(-1/2) once each bead has met a few others, so that spin has got its share. Repeats of five
// seeds. The planes, 20 diameters apart, add 2 % to the collisions. Throws std::runtime_error when a bead is
// lost.
Measured cooling_restitution(const LayerSettings& settings);

}  // namespace demvof
