#include "reference/demvof/bulk_friction/friction_law.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace demvof {

namespace {

constexpr double least_scale = 0.01, largest_scale = 10.0;
constexpr std::size_t fewest_points = 4;  // one more than the law has parameters

struct Trial {
  FrictionLaw law;
  double squares = std::numeric_limits<double>::infinity();
};

// For a given I_0 the law is a straight line in I / (I_0 + I).
Trial line(const std::vector<FrictionPoint>& points, std::size_t left_out, double scale) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (p == left_out) continue;
    const double x = points[p].inertial_number / (scale + points[p].inertial_number);
    n += 1.0;
    sx += x;
    sy += points[p].friction;
    sxx += x * x;
    sxy += x * points[p].friction;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  const double intercept = (sy - slope * sx) / n;
  Trial trial{{intercept, intercept + slope, scale}, 0.0};
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (p == left_out) continue;
    const double miss = points[p].friction - trial.law(points[p].inertial_number);
    trial.squares += miss * miss;
  }
  return trial;
}

// Golden-section search in log I_0.
Trial best(const std::vector<FrictionPoint>& points, std::size_t left_out) {
  constexpr double golden = 0.6180339887498949;
  double low = std::log(least_scale), high = std::log(largest_scale);
  while (high - low > 1e-6) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (line(points, left_out, std::exp(a)).squares < line(points, left_out, std::exp(b)).squares) {
      high = b;
    } else {
      low = a;
    }
  }
  return line(points, left_out, std::exp(0.5 * (low + high)));
}

}  // namespace

double FrictionLaw::operator()(double inertial_number) const {
  return at_rest + (limit - at_rest) * inertial_number / (scale + inertial_number);
}

FrictionFit fit_friction(const std::vector<FrictionPoint>& points) {
  if (points.size() < fewest_points) throw std::invalid_argument("a fit of mu(I) needs four points or more");
  const Trial all = best(points, points.size());
  FrictionFit fit;
  fit.law = all.law;
  const auto n = static_cast<double>(points.size());
  fit.rms = std::sqrt(all.squares / n);
  double at_rest = 0.0, limit = 0.0, scale = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const FrictionLaw other = best(points, p).law;
    at_rest += (other.at_rest - all.law.at_rest) * (other.at_rest - all.law.at_rest);
    limit += (other.limit - all.law.limit) * (other.limit - all.law.limit);
    scale += (other.scale - all.law.scale) * (other.scale - all.law.scale);
  }
  const auto twice_error = [&](double squares) { return 2.0 * std::sqrt((n - 1.0) / n * squares); };
  fit.band = {twice_error(at_rest), twice_error(limit), twice_error(scale)};
  return fit;
}

}  // namespace demvof
