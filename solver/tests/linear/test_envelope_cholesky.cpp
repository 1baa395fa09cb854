#include <algorithm>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "solver/linear/envelope_cholesky.hpp"

namespace granvof::linear {
namespace {

// Rows that begin at irregular columns, among them one that stands alone and one that is full; filled from
// pairs given in either order. `shift` on the diagonal: positive definite from about 20 on.
struct Problem {
  static constexpr int n = 60;
  explicit Problem(double shift) : dense(Eigen::MatrixXd::Zero(n, n)), first(n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (int i = 0; i < n; ++i) first[i] = std::max(0, i - static_cast<int>(random() % 12));
    first[20] = 20;
    first[41] = 0;
    matrix.reset(first);
    for (int i = 0; i < n; ++i) {
      for (int j = first[i]; j <= i; ++j) {
        const double a = i == j ? shift : value(random);
        dense(i, j) = dense(j, i) = a;
        if (i % 2 == 0)
          matrix.add(i, j, a);
        else
          matrix.add(j, i, a);
      }
    }
  }
  Eigen::MatrixXd dense;
  std::vector<int> first;
  EnvelopeCholesky matrix;
};

TEST(EnvelopeCholesky, SolvesWhatADenseFactorisationSolves) {
  Problem p(20.0);
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(Problem::n, -1.0, 2.0);
  const Eigen::VectorXd expected = p.dense.llt().solve(rhs);
  ASSERT_TRUE(p.matrix.factorise());
  Eigen::VectorXd x = rhs;
  p.matrix.solve(x.data());
  EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(EnvelopeCholesky, RefusesWhatIsNotPositiveDefinite) {
  Problem p(0.5);
  ASSERT_LT(p.dense.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  EXPECT_FALSE(p.matrix.factorise());
}

}  // namespace
}  // namespace granvof::linear
