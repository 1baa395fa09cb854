// Times at equal intervals.
#pragma once

#include <vector>

namespace granvof {

// 0, interval, 2 interval, ... below `end`, and `end`; in any unit, 0 < interval <= end. Each is the multiple
// as a person writes it, to 15 digits (3 * 0.1 is 0.3): lists of different intervals share the times that
// they have in common to the last bit.
std::vector<double> regular_times(double interval, double end);

}  // namespace granvof
