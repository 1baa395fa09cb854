#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "solver/linear/conjugate_gradient.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/tests/linear/problem.hpp"

namespace granvof::linear {
namespace {

using testing::Box;
using testing::ScalarSystem;
using testing::Values;
using testing::Vector;

// Two components on boxes of different size, coupled cell by cell where both exist: the friction solve in
// small.
TEST(ConjugateGradient, TwoComponentsWithABlockDiagonalPreconditioner) {
  std::array<Box, 2> box{Box({17, 12, 1}), Box({16, 13, 1})};
  std::array<ScalarSystem, 2> s{
      ScalarSystem(box[0], [&](int, int, int) { return box[0].uniform(0.1, 10.0); }),
      ScalarSystem(box[1], [&](int, int, int) { return box[1].uniform(0.1, 10.0); })};
  for (int c = 0; c < 2; ++c) {
    box[c].each([&](int i, int j, int k) {
      s[c].mass[box[c].layout.index(i, j, k)] = 1.0;
      s[c].rhs[box[c].layout.index(i, j, k)] = box[c].uniform(-1.0, 1.0);
    });
  }
  const double coupling = 0.4;
  const std::array<testing::Matrix, 2> matrix{s[0].matrix(box[0]), s[1].matrix(box[1])};
  const auto apply = [&](const Components& p, const Components& q) {
    for (int c = 0; c < 2; ++c) {
      Vector v(matrix[c].rows());
      box[c].each([&](int i, int j, int k) { v[box[c].row(i, j, k)] = p[c][box[c].layout.index(i, j, k)]; });
      const Vector w = matrix[c] * v;
      box[c].each([&](int i, int j, int k) {
        double value = w[box[c].row(i, j, k)];
        const auto& other = box[1 - c].layout;
        if (i < 16 && j < 12) value += coupling * p[1 - c][other.index(i, j, k)];
        q[c][box[c].layout.index(i, j, k)] = value;
      });
    }
  };
  Multigrid first(box[0].layout), second(box[1].layout);
  first.set(s[0].faces, s[0].mass.data());
  second.set(s[1].faces, s[1].mass.data());
  const auto precondition = [&](const ConstComponents& r, const Components& z) {
    first.apply(r[0], z[0], 2);
    second.apply(r[1], z[1], 2);
  };
  ConjugateGradient solver({box[0].layout, box[1].layout});
  const Report report = solver.solve(apply, precondition, {s[0].rhs.data(), s[1].rhs.data()},
                                     {s[0].x.data(), s[1].x.data()}, {0.0, 1e-10, 60});
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, 40);

  const Eigen::Index n0 = matrix[0].rows(), n1 = matrix[1].rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < 2; ++c)
    for (Eigen::Index column = 0; column < matrix[c].outerSize(); ++column)
      for (testing::Matrix::InnerIterator it(matrix[c], column); it; ++it)
        entries.emplace_back(it.row() + (c ? n0 : 0), it.col() + (c ? n0 : 0), it.value());
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 16; ++i) {
      entries.emplace_back(box[0].row(i, j, 0), n0 + box[1].row(i, j, 0), coupling);
      entries.emplace_back(n0 + box[1].row(i, j, 0), box[0].row(i, j, 0), coupling);
    }
  testing::Matrix whole(n0 + n1, n0 + n1);
  whole.setFromTriplets(entries.begin(), entries.end());
  Vector rhs(n0 + n1), x(n0 + n1);
  rhs << box[0].gather(s[0].rhs), box[1].gather(s[1].rhs);
  x << box[0].gather(s[0].x), box[1].gather(s[1].x);
  const Vector exact = Eigen::SimplicialLDLT<testing::Matrix>(whole).solve(rhs);
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-8 * exact.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(report.final, (rhs - whole * x).lpNorm<Eigen::Infinity>(), 1e-13);
}

// Rows of which one in three is a million times lighter: judged by residual over diagonal every row is as
// good as the tolerance says; judged by the residual itself the light rows are never looked at.
TEST(ConjugateGradient, WeightsJudgeEveryRowByItsOwn) {
  Box b({9, 8, 1});
  Values mass = b.values(1.0), rhs = b.values(), inverse = b.values();
  b.each([&](int i, int j, int k) {
    const auto at = b.layout.index(i, j, k);
    if (i % 3 == 0) mass[at] = 1e-6;
    rhs[at] = mass[at] * b.uniform(0.5, 1.0);
    inverse[at] = 1.0 / mass[at];
  });
  const double coupling = 1e-7;
  const auto apply = [&](const Components& p, const Components& q) {
    b.each([&](int i, int j, int k) {
      const auto at = b.layout.index(i, j, k);
      double sum = mass[at] * p[0][at];
      if (i > 0) sum += coupling * (p[0][at] - p[0][b.layout.index(i - 1, j, k)]);
      if (i < 8) sum += coupling * (p[0][at] - p[0][b.layout.index(i + 1, j, k)]);
      q[0][at] = sum;
    });
  };
  const auto precondition = [&](const ConstComponents& r, const Components& z) {
    b.each([&](int i, int j, int k) { z[0][b.layout.index(i, j, k)] = r[0][b.layout.index(i, j, k)]; });
  };
  const double tolerance = 1e-4;
  for (const bool weighted : {false, true}) {
    Values x = b.values();
    ConjugateGradient solver({b.layout});
    const Report report = solver.solve(apply, precondition, {rhs.data()}, {x.data()}, {tolerance, 0.0, 500},
                                       {weighted ? inverse.data() : nullptr});
    EXPECT_TRUE(report.converged);
    double worst = 0.0;
    Values left = b.values();
    apply({x.data()}, {left.data()});
    b.each([&](int i, int j, int k) {
      const auto at = b.layout.index(i, j, k);
      worst = std::max(worst, std::abs(rhs[at] - left[at]) * inverse[at]);
    });
    if (weighted) {
      EXPECT_LE(worst, tolerance);
      EXPECT_NEAR(report.final, worst, 1e-6 * tolerance);
    } else {
      EXPECT_GT(worst, 0.1);
    }
  }
}

// A solver that is fitted to another part of its memory leaves nothing of the last solve around it.
TEST(ConjugateGradient, IsFittedToAnotherBox) {
  Box b({20, 12, 1});
  const auto laplacian = [&](const Layout& part) {
    return [&b, part](const Components& p, const Components& q) {
      for_each(part, [=, &b](std::ptrdiff_t c) {
        const std::ptrdiff_t t = b.layout.stride[1];
        q[0][c] = 4.1 * p[0][c] - p[0][c - 1] - p[0][c + 1] - p[0][c - t] - p[0][c + t];
      });
    };
  };
  const auto precondition = [&](const Layout& part) {
    return [part](const ConstComponents& r, const Components& z) {
      for_each(part, [=](std::ptrdiff_t c) { z[0][c] = r[0][c]; });
    };
  };
  const Layout wide = part_of(b.layout, {{1, 1, 0}, {19, 11, 1}}),
               narrow = part_of(b.layout, {{6, 4, 0}, {12, 9, 1}});
  Values rhs = b.values(1.0);
  const auto solve = [&](ConjugateGradient& solver, const Layout& part) {
    Values x = b.values(7.0);  // is no guess
    EXPECT_TRUE(solver.solve(laplacian(part), precondition(part), {rhs.data()}, {x.data()}, {0.0, 1e-12, 200})
                    .converged);
    std::vector<double> answer;
    for_each_place(Range::all(part),
                   [&](const std::array<int, 3>& at) { answer.push_back(x[part.index(at)]); });
    return answer;
  };
  ConjugateGradient moved({wide}), fresh({narrow});
  solve(moved, wide);
  moved.fit({narrow});
  EXPECT_EQ(solve(moved, narrow), solve(fresh, narrow));
}

TEST(ConjugateGradient, IndefiniteOperatorIsReported) {
  Box b({8, 8, 1});
  Values rhs = b.values(1.0), x = b.values();
  ConjugateGradient solver({b.layout});
  const auto apply = [&](const Components& p, const Components& q) {
    b.each([&](int i, int j, int k) { q[0][b.layout.index(i, j, k)] = -p[0][b.layout.index(i, j, k)]; });
  };
  const auto precondition = [&](const ConstComponents& r, const Components& z) {
    b.each([&](int i, int j, int k) { z[0][b.layout.index(i, j, k)] = r[0][b.layout.index(i, j, k)]; });
  };
  EXPECT_FALSE(solver.solve(apply, precondition, {rhs.data()}, {x.data()}, {0.0, 1e-8, 50}).converged);
}

}  // namespace
}  // namespace granvof::linear
