#include <cmath>
#include <limits>

#include <Eigen/SparseLU>
#include <gtest/gtest.h>

#include "solver/linear/coupled_solver.hpp"
#include "solver/tests/linear/problem.hpp"

namespace granvof::linear {
namespace {

using testing::BlockSystem;
using testing::Box;
using testing::Vector;

// Grains in the lower left part of the box. Face blocks of two momentum equations coupled by drag beta:
// flux_c and flux_s fractions over the inverse of [m_c + beta, -beta; -beta, m_s + beta].
struct Mixture {
  double drag = 1e6;       // beta, kg/(m3 s)
  double step = 1e-3;      // s
  double gas_from = 2.0;   // height (share of the box) above which the fluid is gas
  double stiffness = 1e6;  // J of packed cells, Pa; 1 where there are no grains
  bool open = true;        // mass in the first equation of the top cells
  double trace = 0.0;      // k21 over k11 where there are no grains to be pushed
};

BlockSystem mixture(Box& b, const Mixture& m) {
  const auto n = b.layout.n;
  const auto share = [n](int row, int d) {
    const std::array<int, 3> at{row % n[0], row / n[0] % n[1], row / (n[0] * n[1])};
    return (at[d] + 0.5) / n[d];
  };
  const auto solid = [=](int row) {
    const bool bed = (n[0] == 1 || share(row, 0) < 0.4) && (n[1] == 1 || share(row, 1) < 0.6);
    return bed ? 0.58 : 0.0;
  };
  const auto density = [=](int row) { return share(row, 1) < m.gas_from ? 1000.0 : 1.0; };
  const double h2 = 1.0 / (2.5e-3 * 2.5e-3);
  BlockSystem s(b, [=](int, int c, int o) -> std::array<double, 4> {
    const double f = 0.5 * (solid(c) + solid(o)), g = 1.0 - f, up_s = solid(c), up_c = 1.0 - up_s;
    const double mc = g * 0.5 * (density(c) + density(o)) / m.step, ms = f * 2500.0 / m.step;
    if (f < 1e-6) return {h2 * g / mc, 0.0, m.trace * h2 * g / mc, 0.0};
    const double beta = m.drag, det = mc * ms + beta * (mc + ms);
    const double i11 = (ms + beta) / det, i12 = beta / det, i22 = (mc + beta) / det;
    return {h2 * (up_c * (i11 * g + i12 * f) + up_s * (i12 * g + i22 * f)), h2 * (up_c * i12 + up_s * i22),
            h2 * up_s * (i12 * g + i22 * f), h2 * up_s * i22};
  });
  double mean = 0.0;
  b.each([&](int i, int j, int k) {
    const auto c = b.layout.index(i, j, k);
    const double f = solid(b.row(i, j, k));
    s.m22[c] = 1.0 / ((f > 0.0 ? m.stiffness : 1.0) * m.step);
    s.m11[c] = m.open && j == n[1] - 1 ? h2 * m.step / 1000.0 : 0.0;
    mean += s.rhs1[c] = b.uniform(-1.0, 1.0);
    s.rhs2[c] = f > 0.0 ? b.uniform(-1.0, 1.0) : 0.0;
  });
  mean /= static_cast<double>(b.layout.count());
  if (!m.open) b.each([&](int i, int j, int k) { s.rhs1[b.layout.index(i, j, k)] -= mean; });
  return s;
}

Report check(Box& b, BlockSystem& s, double relative, double error, bool singular = false) {
  CoupledSolver solver(b.layout);
  const Report report = solver.solve(s.system(), s.x1.data(), s.x2.data(), {0.0, relative, 200});
  EXPECT_TRUE(report.converged) << report.final / report.initial << " after " << report.iterations;
  const auto a = s.matrix(b);
  const Eigen::Index n = a.rows() / 2;
  Vector rhs(2 * n), x(2 * n);
  rhs << b.gather(s.rhs1), b.gather(s.rhs2);
  x << b.gather(s.x1), b.gather(s.x2);
  const Vector residual = rhs - a * x;
  // Two ways to sum the same residual differ by the rounding of its largest terms.
  const double rounding = 1e-15 * (a.cwiseAbs() * x.cwiseAbs()).lpNorm<Eigen::Infinity>();
  EXPECT_LE(residual.head(n).lpNorm<Eigen::Infinity>(),
            relative * rhs.head(n).lpNorm<Eigen::Infinity>() + rounding);
  EXPECT_LE(residual.tail(n).lpNorm<Eigen::Infinity>(),
            relative * rhs.tail(n).lpNorm<Eigen::Infinity>() + rounding);
  EXPECT_NEAR(report.final, residual.lpNorm<Eigen::Infinity>(), rounding);
  testing::Matrix solved = a;
  if (singular) solved.coeffRef(0, 0) += a.coeff(0, 0);
  Eigen::SparseLU<testing::Matrix> lu(solved);
  Vector exact = lu.solve(rhs);
  exact += lu.solve(rhs - solved * exact);
  if (singular) exact.head(n).array() += x.head(n).mean() - exact.head(n).mean();
  EXPECT_LT((x - exact).head(n).lpNorm<Eigen::Infinity>(), error * exact.head(n).lpNorm<Eigen::Infinity>());
  EXPECT_LT((x - exact).tail(n).lpNorm<Eigen::Infinity>(), error * exact.tail(n).lpNorm<Eigen::Infinity>());
  return report;
}

class CoupledShapes : public ::testing::TestWithParam<std::array<int, 6>> {};

TEST_P(CoupledShapes, AgreesWithSparseLu) {
  const auto p = GetParam();
  Box b({p[0], p[1], p[2]}, {p[3] != 0, p[4] != 0, p[5] != 0});
  BlockSystem s = mixture(b, {});
  check(b, s, 1e-9, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Boxes, CoupledShapes,
                         ::testing::Values(std::array{32, 16, 1, 0, 0, 0}, std::array{37, 23, 1, 0, 0, 0},
                                           std::array{9, 7, 11, 0, 0, 0}, std::array{1, 31, 1, 0, 0, 0},
                                           std::array{1, 12, 17, 0, 0, 0}, std::array{16, 12, 1, 1, 0, 0},
                                           std::array{9, 8, 6, 1, 0, 1}));

TEST(CoupledSolver, ClosedBoxIsSingularUpToAConstant) {
  Box b({32, 24, 1});
  BlockSystem s = mixture(b, {.open = false});
  check(b, s, 1e-8, 1e-5, true);
}

TEST(CoupledSolver, GasAboveWater) {
  Box b({40, 30, 1});
  BlockSystem s = mixture(b, {.gas_from = 0.7});
  check(b, s, 1e-8, 1e-5);
}

// With strong drag the blocks are nearly of rank one: k11 k22 - k12 k21 is 1e-6 of k11 k22.
TEST(CoupledSolver, StrongDragAndLongStep) {
  Box b({40, 30, 1});
  BlockSystem s = mixture(b, {.drag = 1e11, .step = 1e-2});
  check(b, s, 1e-7, 1e-4);
}

TEST(CoupledSolver, NoDrag) {
  Box b({40, 30, 1});
  BlockSystem s = mixture(b, {.drag = 0.0});
  check(b, s, 1e-8, 1e-5);
}

TEST(CoupledSolver, SoftAndStiffGrains) {
  for (const double stiffness : {1e2, 1e11}) {
    Box b({40, 30, 1});
    BlockSystem s = mixture(b, {.stiffness = stiffness});
    check(b, s, 1e-8, 1e-4);
  }
}

TEST(CoupledSolver, ApplicationsBarelyGrowWithTheGrid) {
  std::vector<int> counts;
  for (const int n : {40, 80, 160, 320}) {
    Box b({n, n / 2, 1});
    BlockSystem s = mixture(b, {.gas_from = 0.7});
    CoupledSolver solver(b.layout);
    const Report report = solver.solve(s.system(), s.x1.data(), s.x2.data(), {0.0, 1e-6, 100});
    EXPECT_TRUE(report.converged);
    counts.push_back(report.iterations);
  }
  EXPECT_LE(counts.back(), 3 * counts.front()) << counts[0] << " " << counts[1] << " " << counts[2];
  EXPECT_LE(counts.back(), 40) << counts[0] << " " << counts[1] << " " << counts[2];
}

// The second row of a part of the box: there the answer of the whole, beyond it nothing is read or written;
// with one solver for parts that move, grow and end.
TEST(CoupledSolver, SecondRowOfAPart) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const std::array<int, 3> n : {std::array{40, 30, 1}, {37, 23, 1}, {13, 12, 9}}) {
    Box b({n[0], n[1], n[2]});
    BlockSystem s = mixture(b, {.gas_from = 0.7, .trace = 100.0});
    CoupledSolver of_all(b.layout), of_part(b.layout);
    EXPECT_TRUE(of_all.solve(s.system(), s.x1.data(), s.x2.data(), {0.0, 1e-10, 200}).converged);
    const Range bed{{0, 0, 0}, {(2 * n[0] + 4) / 5, (3 * n[1] + 4) / 5, n[2]}};
    for (const int margin : {1, 4, 2}) {
      BlockSystem part = s;
      part.x1 = part.x2 = b.values();
      const Range second{bed.lower, {bed.upper[0] + margin, bed.upper[1] + margin, n[2]}};
      b.each([&](int i, int j, int k) {
        if (second.contains({i, j, k})) return;
        const auto c = b.layout.index(i, j, k);
        part.x2[c] = part.m22[c] = part.rhs2[c] = nothing;
      });
      CoupledSystem system = part.system();
      system.second = second;
      EXPECT_TRUE(of_part.solve(system, part.x1.data(), part.x2.data(), {0.0, 1e-10, 200}).converged);
      const double scale1 = b.gather(s.x1).lpNorm<Eigen::Infinity>(),
                   scale2 = b.gather(s.x2).lpNorm<Eigen::Infinity>();
      b.each([&](int i, int j, int k) {
        const auto c = b.layout.index(i, j, k);
        EXPECT_NEAR(part.x1[c], s.x1[c], 1e-6 * scale1);
        if (second.contains({i, j, k}))
          EXPECT_NEAR(part.x2[c], s.x2[c], 1e-6 * scale2);
        else
          EXPECT_TRUE(std::isnan(part.x2[c]));
      });
    }
    // Without any: the first row by itself.
    BlockSystem first = s;
    first.x1 = b.values();
    first.x2 = first.m22 = first.rhs2 = b.values(nothing);
    CoupledSystem system = first.system();
    system.second = Range{{0, 0, 0}, {0, 0, 0}};
    EXPECT_TRUE(of_part.solve(system, first.x1.data(), first.x2.data(), {0.0, 1e-10, 200}).converged);
    const auto a = s.matrix(b);
    const Eigen::Index cells = a.rows() / 2;
    const Vector x = b.gather(first.x1), rhs = b.gather(first.rhs1);
    const testing::Matrix of_first = a.topLeftCorner(cells, cells);
    EXPECT_LE((rhs - of_first * x).lpNorm<Eigen::Infinity>(), 1e-9 * rhs.lpNorm<Eigen::Infinity>());
  }
}

TEST(CoupledSolver, ZeroRightHandSide) {
  Box b({12, 8, 1});
  BlockSystem s = mixture(b, {});
  s.rhs1 = s.rhs2 = b.values();
  CoupledSolver solver(b.layout);
  const Report report = solver.solve(s.system(), s.x1.data(), s.x2.data(), {0.0, 1e-6, 100});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
}

TEST(CoupledSolver, TooFewIterationsAreReportedWithTheTrueResidual) {
  Box b({40, 30, 1});
  BlockSystem s = mixture(b, {});
  CoupledSolver solver(b.layout);
  const Report report = solver.solve(s.system(), s.x1.data(), s.x2.data(), {0.0, 1e-12, 3});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  const auto a = s.matrix(b);
  Vector rhs(a.rows()), x(a.rows());
  rhs << b.gather(s.rhs1), b.gather(s.rhs2);
  x << b.gather(s.x1), b.gather(s.x2);
  EXPECT_NEAR(report.final, (rhs - a * x).lpNorm<Eigen::Infinity>(), 1e-9 * report.initial);
}

}  // namespace
}  // namespace granvof::linear
