#include "compare/metrics/period.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace granvof::compare {
namespace {

struct Crossings {
  std::vector<double> up, down;
};

Crossings crossings(const Curve& curve, double mean) {
  double square = 0.0;
  for (const double value : curve.value) square += (value - mean) * (value - mean);
  const double band = 0.2 * std::sqrt(square / static_cast<double>(curve.size()));
  Crossings found;
  int side = 0;             // the side of the band last visited
  double crossed_at = 0.0;  // the last crossing of the mean, not confirmed yet
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double now = curve.value[i] - mean;
    if (i > 0) {
      const double before = curve.value[i - 1] - mean;
      if ((before < 0.0) != (now < 0.0))
        crossed_at = curve.time[i - 1] + (curve.time[i] - curve.time[i - 1]) * before / (before - now);
    }
    const int beyond = now > band ? 1 : (now < -band ? -1 : 0);
    if (beyond == 0 || beyond == side) continue;
    if (side != 0) (beyond > 0 ? found.up : found.down).push_back(crossed_at);
    side = beyond;
  }
  return found;
}

// Sum of squares of what a mean, a sine and a cosine of `frequency` leave of the curve.
double left_by(const Curve& curve, double frequency) {
  const auto n = static_cast<Eigen::Index>(curve.size());
  const Eigen::Map<const Eigen::ArrayXd> time(curve.time.data(), n);
  const Eigen::Map<const Eigen::VectorXd> value(curve.value.data(), n);
  const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * frequency * (time - time(0));
  Eigen::MatrixX3d basis(n, 3);
  basis.col(0).setOnes();
  basis.col(1) = phase.cos();
  basis.col(2) = phase.sin();
  return (value - basis * basis.colPivHouseholderQr().solve(value)).squaredNorm();
}

}  // namespace

std::optional<Oscillation> oscillation(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  auto mean = time_mean(inside);
  if (!mean) return std::nullopt;
  Crossings found;
  for (int repeat = 0; repeat < 4; ++repeat) {
    found = crossings(inside, *mean);
    if (found.up.size() < 2) return std::nullopt;
    const auto refined = time_mean(clip(inside, {found.up.front(), found.up.back()}));
    if (!refined) return std::nullopt;
    mean = refined;
  }
  // Upward and downward crossings err in opposite directions when the mean is off: use both.
  double total = found.up.back() - found.up.front();
  std::size_t cycles = found.up.size() - 1;
  if (found.down.size() >= 2) {
    total += found.down.back() - found.down.front();
    cycles += found.down.size() - 1;
  }
  if (found.up.size() < 3 && found.down.size() < 3) return std::nullopt;
  return Oscillation{total / static_cast<double>(cycles), static_cast<int>(found.up.size()) - 1,
                     0.5 * (*maximum(inside) - *minimum(inside))};
}

std::optional<double> fitted_period(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  constexpr std::size_t samples_a_cycle = 4;
  if (inside.size() < 2 * samples_a_cycle) return std::nullopt;
  const double duration = inside.time.back() - inside.time.front();
  const double least = 2.0 / duration;
  // Far finer than modes that a window can tell apart, 1 / duration.
  const double step = 0.05 / duration;
  const auto most = static_cast<double>(inside.size() / samples_a_cycle) / duration;
  double best = least, left = left_by(inside, least);
  for (double frequency = least + step; frequency <= most; frequency += step) {
    const double left_now = left_by(inside, frequency);
    if (left_now < left) {
      best = frequency;
      left = left_now;
    }
  }
  if (best == least || !(left < 0.5 * left_by(inside, 0.0))) return std::nullopt;
  double lower = best - step, upper = best + step;
  while (upper - lower > 1e-9 * best) {
    const double third = (upper - lower) / 3.0;
    if (left_by(inside, lower + third) < left_by(inside, upper - third)) {
      upper -= third;
    } else {
      lower += third;
    }
  }
  return 1.0 / (0.5 * (lower + upper));
}

}  // namespace granvof::compare
