// Period of an oscillation: from its zero crossings (paper, section 4.3, Fig. 12b), or of its strongest mode.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct Oscillation {
  double period = 0.0;     // [s]
  int cycles = 0;          // whole cycles that the period was taken from
  double amplitude = 0.0;  // half of the range inside the window
};

// Crossings of the mean, interpolated linearly. A crossing counts once the curve has gone beyond 0.2 rms on
// the other side, so that ripples on a flank are not cycles. The mean is taken between the first and the last
// upward crossing, that is over whole cycles, by repetition. Nothing for fewer than two whole cycles.
std::optional<Oscillation> oscillation(const Curve& curve, Window window);

// Period of the mean, sine and cosine that leave least of the curve: of the strongest of several modes, which
// crossings take for one. Nothing where the window holds fewer than two of its cycles, or no mode has half of
// the motion.
std::optional<double> fitted_period(const Curve& curve, Window window);

}  // namespace granvof::compare
