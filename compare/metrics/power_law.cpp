#include "compare/metrics/power_law.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace granvof::compare {

std::optional<PowerLaw> power_law(const Curve& curve, Window window) {
  const Curve inside = clip(curve, window);
  std::vector<double> log_time, log_value;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside.time[i] <= 0.0 || inside.value[i] <= 0.0) continue;
    log_time.push_back(std::log(inside.time[i]));
    log_value.push_back(std::log(inside.value[i]));
  }
  if (log_time.size() < 2) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(log_time.size());
  Eigen::MatrixX2d basis(n, 2);
  basis.col(0).setOnes();
  basis.col(1) = Eigen::Map<const Eigen::VectorXd>(log_time.data(), n);
  const Eigen::Vector2d solved =
      basis.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(log_value.data(), n));
  return PowerLaw{std::exp(solved(0)), solved(1)};
}

}  // namespace granvof::compare
