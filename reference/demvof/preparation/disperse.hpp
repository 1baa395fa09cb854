// Beads at random in a box, without overlap.
#pragma once

#include <random>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

// `count` beads with centres at least half a diameter inside the box (in z: periodic or the same). Uniformly
// random places, then overlaps pushed apart until none is deeper than 1 % of the diameter; works up to a
// solid fraction of about 0.55. Throws std::runtime_error when the overlaps do not vanish. Three numbers a
// bead.
std::vector<double> disperse_beads(std::size_t count, const Vector& lower, const Vector& upper,
                                   bool periodic_depth, double diameter, std::mt19937& random);

}  // namespace demvof
