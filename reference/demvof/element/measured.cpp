#include "reference/demvof/element/measured.hpp"

#include <cmath>
#include <stdexcept>

namespace demvof {

Measured mean_of(const std::vector<double>& repeats) {
  const auto n = static_cast<double>(repeats.size());
  if (repeats.size() < 2) throw std::invalid_argument("a band needs two repeats or more");
  double sum = 0.0, squares = 0.0;
  for (const double x : repeats) sum += x;
  const double mean = sum / n;
  for (const double x : repeats) squares += (x - mean) * (x - mean);
  return {mean, 2.0 * std::sqrt(squares / (n - 1.0) / n)};
}

Measured intercept_of(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    sx += x[p];
    sy += y[p];
    sxx += x[p] * x[p];
    sxy += x[p] * y[p];
  }
  const double spread = n * sxx - sx * sx;
  if (x.size() < 3 || !(spread > 0.0))
    throw std::invalid_argument("a line needs three points at more than one place");
  const double slope = (n * sxy - sx * sy) / spread, intercept = (sy - slope * sx) / n;
  double squares = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double miss = y[p] - intercept - slope * x[p];
    squares += miss * miss;
  }
  return {intercept, 2.0 * std::sqrt(squares / (n - 2.0) * sxx / spread)};
}

}  // namespace demvof
