#include "compare/metrics/line_fit.hpp"

#include <Eigen/Dense>

namespace granvof::compare {

Line line_fit(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixX2d basis(n, 2);
  basis.col(0).setOnes();
  basis.col(1) = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  const Eigen::Vector2d solved =
      basis.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), n));
  return {solved(0), solved(1)};
}

}  // namespace granvof::compare
