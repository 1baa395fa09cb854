// Beads that come to rest.
#pragma once

#include "reference/demvof/beads/bead_engine.hpp"

namespace demvof {

inline constexpr double nearly_still = 0.10;  // rms speed that ends a settling under preparation, sqrt(g d)
inline constexpr double quite_still = 0.02;   // under the law of the run

double rms_speed(const BeadState& state);  // [m/s]; 0 without beads

// Runs under a drag that stands for a liquid until the rms speed is below `still_share` sqrt(g d). Throws
// std::runtime_error when that takes more than 1.5 s, granvof::StopRequested where a signal asks for the
// end. The drag stays in force.
void settle(BeadEngine& engine, double still_share);

}  // namespace demvof
