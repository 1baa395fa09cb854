#include <cmath>

#include <gtest/gtest.h>

#include "solver/linear/multigrid.hpp"
#include "solver/tests/linear/problem.hpp"

namespace granvof::linear {
namespace {

using testing::Box;
using testing::ScalarSystem;
using testing::Values;
using testing::Vector;

class EveryShape : public ::testing::TestWithParam<std::array<int, 6>> {
 protected:
  Box box() const {
    const auto p = GetParam();
    return Box({p[0], p[1], p[2]}, {p[3] != 0, p[4] != 0, p[5] != 0});
  }
};

// V is symmetric and positive, and I - V A contracts in the energy norm: what CG and the sweeps rely on.
TEST_P(EveryShape, CycleIsASymmetricContraction) {
  Box b = box();
  ScalarSystem s(b, [&](int, int, int) { return b.uniform(0.1, 10.0); });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = b.uniform(0.01, 0.1); });
  Multigrid multigrid(b.layout);
  multigrid.set(s.faces, s.mass.data());
  const auto a = s.matrix(b);
  const auto random = [&] {
    Values v = b.values();
    b.each([&](int i, int j, int k) { v[b.layout.index(i, j, k)] = b.uniform(-1.0, 1.0); });
    return v;
  };
  for (const int smoothing : {1, 2, 3, 4}) {
    const Values u = random(), v = random();
    Values zu = b.values(), zv = b.values(), e = random();
    multigrid.apply(u.data(), zu.data(), smoothing);
    multigrid.apply(v.data(), zv.data(), smoothing);
    const Vector du = b.gather(u), dv = b.gather(v), dzu = b.gather(zu), dzv = b.gather(zv);
    EXPECT_NEAR(du.dot(dzv), dv.dot(dzu), 1e-5 * std::sqrt(du.dot(dzu) * dv.dot(dzv))) << smoothing;
    EXPECT_GT(du.dot(dzu), 0.0);
    double rate = 0.0;
    for (int step = 0; step < 8; ++step) {
      const Vector before = b.gather(e);
      const Vector ae = a * before;
      Values r = b.values(), z = b.values();
      b.each([&](int i, int j, int k) { r[b.layout.index(i, j, k)] = ae[b.row(i, j, k)]; });
      multigrid.apply(r.data(), z.data(), smoothing);
      b.each([&](int i, int j, int k) { e[b.layout.index(i, j, k)] -= z[b.layout.index(i, j, k)]; });
      const Vector after = b.gather(e);
      if (before.norm() < 1e-4) break;  // single precision
      rate = std::sqrt(after.dot(a * after) / before.dot(ae));
    }
    EXPECT_LT(rate, smoothing == 1 ? 1.0 : 0.7) << "smoothing " << smoothing;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape,
                         ::testing::Values(std::array{16, 16, 1, 0, 0, 0}, std::array{37, 23, 1, 0, 0, 0},
                                           std::array{9, 7, 11, 0, 0, 0}, std::array{1, 31, 1, 0, 0, 0},
                                           std::array{1, 12, 17, 0, 0, 0}, std::array{20, 1, 9, 0, 0, 0},
                                           std::array{16, 12, 1, 1, 0, 0}, std::array{15, 9, 1, 0, 1, 0},
                                           std::array{33, 17, 1, 1, 1, 0}, std::array{10, 8, 6, 1, 1, 1},
                                           std::array{2, 2, 1, 1, 1, 0}, std::array{3, 1, 1, 1, 0, 0},
                                           std::array{5, 8, 1, 1, 1, 1}, std::array{1040, 3, 1, 0, 0, 0}));

TEST(Multigrid, OneCellIsSolvedByItsDiagonal) {
  Box b({1, 1, 1});
  Values mass = b.values(4.0), r = b.values(2.0), z = b.values();
  Multigrid multigrid(b.layout);
  multigrid.set(Faces{}, mass.data());
  multigrid.apply(r.data(), z.data(), 2);
  EXPECT_FLOAT_EQ(static_cast<float>(z[b.layout.index(0, 0, 0)]), 0.5F);
}

// A row without mass and faces returns r and changes nothing elsewhere.
TEST(Multigrid, MaskedRowsAreApart) {
  Box b({13, 10, 1});
  const auto masked = [&](int row) { return row % 7 == 3; };
  ScalarSystem s(b, [&](int, int c, int o) { return masked(c) || masked(o) ? 0.0 : 1.0; });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = masked(b.row(i, j, k)) ? 0.0 : 0.1; });
  Multigrid multigrid(b.layout);
  multigrid.set(s.faces, s.mass.data());
  Values r = b.values(), other = b.values(), z = b.values(), z_other = b.values();
  b.each([&](int i, int j, int k) {
    const auto c = b.layout.index(i, j, k);
    r[c] = b.uniform(-1.0, 1.0);
    other[c] = masked(b.row(i, j, k)) ? 1e6 : r[c];
  });
  multigrid.apply(r.data(), z.data(), 2);
  multigrid.apply(other.data(), z_other.data(), 2);
  b.each([&](int i, int j, int k) {
    const auto c = b.layout.index(i, j, k);
    EXPECT_EQ(z[c], masked(b.row(i, j, k)) ? r[c] : z_other[c]);
  });
}

// Cells ten times longer than high: coarsening only the short direction first keeps the rate.
TEST(Multigrid, SpacingMakesItCoarsenTheStrongDirectionFirst) {
  Box b({32, 32, 1});
  ScalarSystem s(b, [&](int d, int, int) { return d == 0 ? 0.01 : 1.0; });
  b.each([&](int i, int j, int k) { s.mass[b.layout.index(i, j, k)] = 1e-4; });
  const auto rate = [&](const std::array<double, 3>& spacing) {
    Multigrid multigrid(b.layout, spacing);
    multigrid.set(s.faces, s.mass.data());
    const auto a = s.matrix(b);
    Values e = b.values();
    b.each([&](int i, int j, int k) { e[b.layout.index(i, j, k)] = b.uniform(-1.0, 1.0); });
    double last = 0.0;
    for (int step = 0; step < 6; ++step) {
      const Vector before = b.gather(e), ae = a * before;
      Values r = b.values(), z = b.values();
      b.each([&](int i, int j, int k) { r[b.layout.index(i, j, k)] = ae[b.row(i, j, k)]; });
      multigrid.apply(r.data(), z.data(), 2);
      b.each([&](int i, int j, int k) { e[b.layout.index(i, j, k)] -= z[b.layout.index(i, j, k)]; });
      const Vector after = b.gather(e);
      last = std::sqrt(after.dot(a * after) / before.dot(ae));
    }
    return last;
  };
  const double told = rate({10.0, 1.0, 1.0}), untold = rate({1.0, 1.0, 1.0});
  EXPECT_LT(told, 0.65);
  EXPECT_LT(told, untold);
}

}  // namespace
}  // namespace granvof::linear
