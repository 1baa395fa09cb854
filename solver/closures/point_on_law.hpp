// Where a straight response line meets the pressure law of a cell.
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof::closures {

// Solid fraction f with f + compliance P(f) = f_line + compliance p_line, P = law(f).value, never falling
// with f. compliance >= 0 [1/Pa]. Bracketed (Illinois), to 1e-8 in f; f is kept in [0, 0.9].
template <typename Law>
double point_on_law(Law&& law, double f_line, double p_line, double compliance) {
  const auto off = [&](double f) { return (f - f_line) + compliance * (law(f).value - p_line); };
  constexpr double close_enough = 1e-9;  // `off` rises at least as fast as f: the root is no further away
  // P >= 0: the root is not above f_line + compliance p_line, and not below it less compliance P there.
  double high = std::clamp(f_line + compliance * p_line, 0.0, 0.9), off_high = off(high);
  if (off_high <= close_enough) return high;
  double low = std::clamp(std::min(f_line, high), 0.0, 0.9), off_low = off(low);
  if (off_low >= 0.0) {
    high = low;
    off_high = off_low;
    low = 0.0;
    off_low = off(0.0);
    if (off_low >= 0.0) return 0.0;
  }
  for (int iteration = 0; iteration < 60 && high - low > 1e-8; ++iteration) {
    double f = high - off_high * (high - low) / (off_high - off_low);
    if (iteration % 3 == 2) f = 0.5 * (low + high);  // the law is steep: do not let one end stick
    const double there = off(f);
    if (std::fabs(there) <= close_enough) return f;
    if (there > 0.0) {
      high = f;
      off_high = there;
      off_low *= 0.5;
    } else {
      low = f;
      off_low = there;
      off_high *= 0.5;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace granvof::closures
