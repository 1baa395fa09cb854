// Excess pore pressure at the base of a column (paper, section 4.1, Fig. 5).
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// The excess over the value that the same base carries at rest [Pa]; `rest` is the hydrostatic pressure.
Curve excess_pressure(const Curve& base_pressure, double rest);

// The value of largest magnitude in the window, with its sign [Pa].
std::optional<double> peak_pressure(const Curve& excess, Window window);

// +1 or -1: the sign of the time integral over the window (a curve that rings is judged by its integral, not
// by one sample); 0 where the mean is smaller in magnitude than `quiet` [Pa]; nothing for under two samples.
std::optional<double> onset_sign(const Curve& excess, Window window, double quiet);

}  // namespace granvof::compare
