#include <cmath>

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "solver/linear/scalar_solver.hpp"
#include "solver/tests/linear/problem.hpp"

namespace granvof::linear {
namespace {

using testing::Box;
using testing::ScalarSystem;
using testing::Values;
using testing::Vector;

// Solves, and compares residual and answer with Eigen's; `error` is relative to the largest value.
Report check(Box& b, ScalarSystem& s, double relative, double error, bool singular = false) {
  ScalarSolver solver(b.layout);
  const Tolerance tolerance{0.0, relative, 100};
  const Report report = solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), tolerance);
  const auto a = s.matrix(b);
  const Vector rhs = b.gather(s.rhs), x = b.gather(s.x);
  const Vector residual = rhs - a * x;
  EXPECT_TRUE(report.converged) << report.final / report.initial << " after " << report.iterations;
  EXPECT_NEAR(report.final, residual.lpNorm<Eigen::Infinity>(), 1e-3 * relative * report.initial);
  EXPECT_LE(report.final, relative * report.initial);
  Vector exact;
  if (singular) {  // fix the constant
    testing::Matrix pinned = a;
    pinned.coeffRef(0, 0) += a.coeff(0, 0);
    exact = Eigen::SimplicialLDLT<testing::Matrix>(pinned).solve(rhs);
    exact.array() += x.mean() - exact.mean();
  } else {
    exact = Eigen::SimplicialLDLT<testing::Matrix>(a).solve(rhs);
  }
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), error * exact.lpNorm<Eigen::Infinity>());
  return report;
}

void random_rhs(Box& b, ScalarSystem& s, bool consistent = false) {
  double mean = 0.0;
  b.each([&](int i, int j, int k) { mean += s.rhs[b.layout.index(i, j, k)] = b.uniform(-1.0, 1.0); });
  mean /= static_cast<double>(b.layout.count());
  if (consistent) b.each([&](int i, int j, int k) { s.rhs[b.layout.index(i, j, k)] -= mean; });
}

class ScalarShapes : public ::testing::TestWithParam<std::array<int, 6>> {};

TEST_P(ScalarShapes, AgreesWithCholesky) {
  const auto p = GetParam();
  Box b({p[0], p[1], p[2]}, {p[3] != 0, p[4] != 0, p[5] != 0});
  ScalarSystem s(b, [&](int, int, int) { return b.uniform(0.1, 10.0); });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = b.uniform(0.01, 1.0); });
  random_rhs(b, s);
  check(b, s, 1e-11, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Boxes, ScalarShapes,
                         ::testing::Values(std::array{16, 16, 1, 0, 0, 0}, std::array{37, 23, 1, 0, 0, 0},
                                           std::array{9, 7, 11, 0, 0, 0}, std::array{1, 31, 1, 0, 0, 0},
                                           std::array{1, 12, 17, 0, 0, 0}, std::array{20, 1, 9, 0, 0, 0},
                                           std::array{16, 12, 1, 1, 0, 0}, std::array{15, 9, 1, 0, 1, 0},
                                           std::array{10, 8, 6, 1, 1, 1}, std::array{2, 2, 1, 1, 1, 0},
                                           std::array{1, 1, 1, 0, 0, 0}, std::array{130, 80, 1, 0, 0, 0}));

// A right-hand side of 1e-24, as a small Theta has: its squares are none in single precision.
TEST(ScalarSolver, SmallResidualsAreSolvedLikeLargeOnes) {
  const double small = std::ldexp(1.0, -80);
  Box b({24, 16, 1}, {false, false, false});
  ScalarSystem s(b, [&](int, int, int) { return b.uniform(0.1, 10.0); });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = b.uniform(0.01, 1.0); });
  random_rhs(b, s);
  const Report large = check(b, s, 1e-10, 1e-8);
  const Values answer = s.x;
  b.each([&](int i, int j, int k) {
    s.rhs[b.layout.index(i, j, k)] *= small;
    s.x[b.layout.index(i, j, k)] = 0.0;
  });
  const Report report = check(b, s, 1e-10, 1e-8);
  EXPECT_EQ(report.iterations, large.iterations);
  b.each([&](int i, int j, int k) {
    EXPECT_EQ(s.x[b.layout.index(i, j, k)], small * answer[b.layout.index(i, j, k)]);
  });
}

TEST(ScalarSolver, ClosedBoxWithDensityRatioAThousand) {
  for (const bool periodic : {false, true}) {
    Box b({40, 30, 1}, {periodic, periodic, false});
    const auto density = [&](int row) {
      const int i = row % 40, j = row / 40;
      return (j < 15) != (std::hypot(i - 12, j - 8) < 5) ? 1000.0 : 1.0;
    };
    ScalarSystem s(b, [&](int, int c, int o) { return 2.0 / (density(c) + density(o)); });
    random_rhs(b, s, true);
    const Report report = check(b, s, 1e-9, 1e-6, true);
    EXPECT_LT(report.iterations, 40);
  }
}

TEST(ScalarSolver, FrictionContrastOfTenOrders) {
  Box b({40, 30, 1});
  const auto viscosity = [&](int row) { return row % 40 < 17 && row / 40 < 20 ? 1e5 : 1e-5; };
  ScalarSystem s(b, [&](int, int c, int o) { return 0.5 * (viscosity(c) + viscosity(o)); });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = 1.0; });
  random_rhs(b, s);
  const Report report = check(b, s, 1e-6, 1e-5);
  EXPECT_LT(report.iterations, 20);
}

TEST(ScalarSolver, MaskedRowsKeepTheirGuess) {
  Box b({20, 15, 1});
  const auto masked = [&](int row) { return row % 20 > 9 && row / 20 > 5; };
  ScalarSystem s(b, [&](int, int c, int o) { return masked(c) || masked(o) ? 0.0 : 1.0; });
  random_rhs(b, s);
  b.each([&](int i, int j, int k) {
    const auto c = b.layout.index(i, j, k);
    const bool m = masked(b.row(i, j, k));
    s.mass[c] = m ? 0.0 : 0.1;
    if (m) s.rhs[c] = 0.0;
    if (m) s.x[c] = 3.0;
  });
  ScalarSolver solver(b.layout);
  EXPECT_TRUE(solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-8, 100}).converged);
  b.each([&](int i, int j, int k) {
    if (masked(b.row(i, j, k))) {
      EXPECT_EQ(s.x[b.layout.index(i, j, k)], 3.0);
    }
  });
}

// nullptr leaves a direction of many cells uncoupled: planes are solved apart, and no worse for it.
TEST(ScalarSolver, UncoupledDirection) {
  Box b({16, 12, 6});
  ScalarSystem s(b, [&](int d, int, int) { return d == 1 ? 0.0 : 1.0; });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = 1e-3; });
  random_rhs(b, s);
  s.faces.lower[1] = nullptr;
  const Report report = check(b, s, 1e-9, 1e-6);
  EXPECT_LT(report.iterations, 25);
}

TEST(ScalarSolver, ZeroRightHandSideAndGuess) {
  Box b({12, 8, 1});
  ScalarSystem s(b, [](int, int, int) { return 1.0; });
  ScalarSolver solver(b.layout);
  const Report report = solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-8, 100});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(b.gather(s.x).norm(), 0.0);
}

TEST(ScalarSolver, IncompatibleRightHandSideIsReported) {
  Box b({12, 8, 1});
  ScalarSystem s(b, [](int, int, int) { return 1.0; });
  b.each([&](int i, int j, int k) { s.rhs[b.layout.index(i, j, k)] = 1.0 + 0.1 * i; });
  ScalarSolver solver(b.layout);
  const Report report = solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-8, 50});
  EXPECT_FALSE(report.converged);
}

TEST(ScalarSolver, NotANumberIsReported) {
  Box b({12, 8, 1});
  ScalarSystem s(b, [](int, int, int) { return 1.0; });
  b.each(
      [&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = s.rhs[b.layout.index(i, j, k)] = 1.0; });
  s.rhs[b.layout.index(3, 3, 0)] = std::nan("");
  ScalarSolver solver(b.layout);
  const Report report = solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {1e9, 1e-8, 50});
  EXPECT_FALSE(report.converged);
}

// A refused step leaves nothing behind: after coefficients that are not numbers the solver works as before.
TEST(ScalarSolver, RecoversFromNotANumber) {
  Box b({37, 23, 1});
  ScalarSystem s(b, [&](int, int, int) { return b.uniform(0.1, 10.0); });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = 0.1; });
  random_rhs(b, s);
  ScalarSolver solver(b.layout);
  const Tolerance tolerance{0.0, 1e-8, 50};
  ScalarSystem bad = s;
  for (int d = 0; d < 2; ++d) bad.faces.lower[d] = bad.face[d].data();
  bad.face[0][b.layout.index(5, 5, 0)] = std::nan("");
  bad.mass[b.layout.index(36, 22, 0)] = std::nan("");
  EXPECT_FALSE(solver.solve(bad.faces, bad.mass.data(), bad.rhs.data(), bad.x.data(), tolerance).converged);
  Multigrid multigrid(b.layout);  // the solver refuses before it reaches multigrid, so ask that too
  Values z = b.values(), again = b.values();
  multigrid.set(s.faces, s.mass.data());
  multigrid.apply(s.rhs.data(), z.data(), 2);
  multigrid.set(bad.faces, bad.mass.data());
  multigrid.apply(s.rhs.data(), again.data(), 2);
  multigrid.set(s.faces, s.mass.data());
  multigrid.apply(s.rhs.data(), again.data(), 2);
  EXPECT_EQ(b.gather(z), b.gather(again));
  EXPECT_TRUE(solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), tolerance).converged);
}

// The count must not grow with the grid: density 1:1000, from 2 000 to 131 000 cells.
TEST(ScalarSolver, IterationsDoNotGrowWithTheGrid) {
  std::vector<int> counts;
  for (const int n : {64, 128, 256, 512}) {
    Box b({n, n / 2, 1});
    const auto density = [&](int row) { return row / n < n / 4 ? 1000.0 : 1.0; };
    ScalarSystem s(b, [&](int, int c, int o) { return 2.0 / (density(c) + density(o)); });
    random_rhs(b, s, true);
    ScalarSolver solver(b.layout);
    const Report report = solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-6, 100});
    EXPECT_TRUE(report.converged);
    counts.push_back(report.iterations);
  }
  EXPECT_LE(counts.back(), counts.front() + 8) << counts[0] << " " << counts[1] << " " << counts[2];
  EXPECT_LE(counts.back(), 24);
}

// Mirroring an even box mirrors every coarse cell as well, so the answer is the mirror image to rounding.
TEST(ScalarSolver, MirroredSystemHasTheMirroredAnswer) {
  constexpr int n = 32;
  Box b({n, 16, 1});
  const auto build = [&](bool mirror) {
    ScalarSystem s(b, [&](int, int, int) { return 0.0; });
    b.each([&](int i, int j, int k) {
      const int from = mirror ? n - 1 - i : i, face = mirror ? n - i : i;
      const auto c = b.layout.index(i, j, k);
      s.rhs[c] = std::sin(0.7 * from) + std::cos(0.3 * j * from);
      s.mass[c] = 0.01;
      if (i > 0) s.face[0][c] = 1.0 + 0.5 * std::sin(1.3 * face + j);
      if (j > 0) s.face[1][c] = 1.0 + 0.5 * std::sin(0.9 * from + j);
    });
    ScalarSolver solver(b.layout);
    EXPECT_TRUE(solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-6, 100}).converged);
    return s.x;
  };
  const Values x = build(false), y = build(true);
  double largest = 0.0, difference = 0.0;
  b.each([&](int i, int j, int k) {
    largest = std::max(largest, std::abs(x[b.layout.index(i, j, k)]));
    difference =
        std::max(difference, std::abs(x[b.layout.index(i, j, k)] - y[b.layout.index(n - 1 - i, j, k)]));
  });
  EXPECT_LT(difference, 1e-8 * largest);  // a hundredth of what the tolerance would leave
}

}  // namespace
}  // namespace granvof::linear
