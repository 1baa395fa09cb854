#include "compare/metrics/decay_rate.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace granvof::compare {
namespace {

struct Fit {
  double rest = 0.0, amplitude = 0.0, misfit = 0.0;
};

Fit fit_at_rate(const Curve& curve, double rate) {
  const auto n = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixX2d basis(n, 2);
  Eigen::VectorXd value(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto s = static_cast<std::size_t>(i);
    basis(i, 0) = 1.0;
    basis(i, 1) = std::exp(-rate * (curve.time[s] - curve.time[0]));
    value(i) = curve.value[s];
  }
  const Eigen::Vector2d solved = basis.colPivHouseholderQr().solve(value);
  return {solved(0), solved(1), (basis * solved - value).squaredNorm()};
}

}  // namespace

std::optional<Decay> exponential_approach(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  if (inside.size() < 5) return std::nullopt;
  const double length = inside.time.back() - inside.time.front();
  // Coarse scan in log k, then golden section: the misfit need not be convex, the scan finds the right
  // valley.
  constexpr int scans = 120;
  const double log_low = std::log(0.1 / length);
  const double log_high = std::log(200.0 / length);
  const double step = (log_high - log_low) / scans;
  int best = 0;
  double least = -1.0;
  for (int i = 0; i <= scans; ++i) {
    const double misfit = fit_at_rate(inside, std::exp(log_low + i * step)).misfit;
    if (least < 0.0 || misfit < least) {
      least = misfit;
      best = i;
    }
  }
  if (best == 0 || best == scans) return std::nullopt;
  double low = log_low + (best - 1) * step;
  double high = log_low + (best + 1) * step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-10) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    if (fit_at_rate(inside, std::exp(left)).misfit < fit_at_rate(inside, std::exp(right)).misfit)
      high = right;
    else
      low = left;
  }
  const double rate = std::exp(0.5 * (low + high));
  const Fit fit = fit_at_rate(inside, rate);
  if (fit.amplitude == 0.0) return std::nullopt;
  const double rms = std::sqrt(fit.misfit / static_cast<double>(inside.size()));
  return Decay{rate, fit.rest, fit.amplitude, rms / std::abs(fit.amplitude)};
}

std::optional<double> envelope_decay_rate(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  const auto mean = time_mean(inside);
  if (!mean) return std::nullopt;
  std::vector<double> time, log_peak;
  double peak = 0.0, peak_time = 0.0;
  int half_cycles = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const double deviation = inside.value[i] - *mean;
    if (i > 0 && (deviation < 0.0) != (inside.value[i - 1] - *mean < 0.0)) {
      if (half_cycles > 0 && peak > 0.0) {  // the first half cycle is cut by the window
        time.push_back(peak_time);
        log_peak.push_back(std::log(peak));
      }
      ++half_cycles;
      peak = 0.0;
    }
    if (std::abs(deviation) > peak) {
      peak = std::abs(deviation);
      peak_time = inside.time[i];
    }
  }
  if (time.size() < 2) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(time.size());
  Eigen::MatrixX2d basis(n, 2);
  basis.col(0).setOnes();
  basis.col(1) = Eigen::Map<const Eigen::VectorXd>(time.data(), n);
  const Eigen::Vector2d solved =
      basis.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(log_peak.data(), n));
  return -solved(1);
}

}  // namespace granvof::compare
