// A scalar against time: what every metric is computed from.
//
// Only defined samples are in a curve: an undefined value of series.csv (an empty field) is left out, it is
// neither 0 nor NaN. Times ascend. All quantities in SI units.
#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace granvof::compare {

struct Curve {
  std::vector<double> time;   // [s], or another stated abscissa, strictly ascending
  std::vector<double> value;  // same size
  // Samples further apart than this are not joined: between them nothing is known [as time].
  double widest = std::numeric_limits<double>::infinity();

  bool empty() const { return time.empty(); }
  std::size_t size() const { return time.size(); }
};

// An interval of the abscissa, both ends included.
struct Window {
  double begin = 0.0;
  double end = 0.0;
};

// The samples of `curve` inside `window`.
Curve clip(const Curve& curve, Window window);

// Linear interpolation at `time`; nothing outside the sampled range (no extrapolation), except that a time
// beyond an end by less than 1e-9 of the range counts as that end, and nothing between two samples that are
// further apart than `widest`.
std::optional<double> value_at(const Curve& curve, double time);

// Integral over the samples by the trapezoidal rule; nothing for fewer than two samples, or across a gap.
std::optional<double> integral(const Curve& curve);

// Time mean (integral over duration), so that uneven sampling does not weigh in; nothing for fewer than two
// samples, or across a gap.
std::optional<double> time_mean(const Curve& curve);

// Largest and smallest value; nothing for an empty curve.
std::optional<double> maximum(const Curve& curve);
std::optional<double> minimum(const Curve& curve);

// The mean of curves of the same quantity, at the times of any where all have a value, so that it ends where
// the first of them ends, in whatever order they are given; at least one curve.
Curve mean_curve(const std::vector<Curve>& curves);

}  // namespace granvof::compare
