// Convective acceleration: exact for linear velocities, its order on smooth ones, no new extremum at a step.
#include <numbers>

#include <gtest/gtest.h>

#include "solver/operators/convection.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::make_periodic;
using test::Tank;
using test::unit_scene;

Field unit_mass(const Grid& grid) {
  return Field(grid, 1.0);
}

TEST(Convection, ExactForLinearVelocities) {
  const double g[3][3] = {{0.3, -1.1, 0.7}, {2.0, -0.4, 0.2}, {-0.9, 1.3, 0.6}};
  for (int dim : {2, 3}) {
    const Tank s(unit_scene(dim, 5));
    std::array<Tank::Function, 3> u;
    for (int d = 0; d < 3; ++d)
      u[d] = [&, d](const Vec3& x) {
        double value = 0.1 * (d - 1);
        for (int e = 0; e < dim; ++e) value += g[d][e] * (x[e] - 0.5);  // every sign of every carrier occurs
        return value;
      };
    const FaceField v = s.faces(u);
    for (bool limited : {false, true}) {
      for (int d = 0; d < dim; ++d) {
        Field a(s.grid, 1e9);
        const double taken = convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), v, d,
                                                     s.grid.all_faces(d), limited, a);
        EXPECT_NEAR(taken, 0.0, 1e-10) << "upwind takes nothing from what is linear";
        s.each(s.grid.all_faces(d), [&](int i, int j, int k, std::ptrdiff_t c) {
          // on the outermost faces the carrier reaches beyond the box, which is filled too
          double expected = 0.0;
          for (int e = 0; e < dim; ++e) expected -= u[e](s.face(d, i, j, k)) * g[d][e];
          EXPECT_NEAR(a[c], expected, 1e-12) << dim << limited << d;
        });
      }
    }
  }
}

constexpr double k = 2.0 * std::numbers::pi;

// A smooth periodic velocity; every sign of both components occurs.
double u0(const Vec3& x) {
  return 0.7 + std::sin(k * x[0]) * std::cos(k * x[1]);
}
double u1(const Vec3& x) {
  return -0.4 + std::cos(k * x[0]) * std::sin(k * x[1]);
}

Scene periodic_square(int n) {
  Scene scene = unit_scene(2, n);
  make_periodic(scene, 0);
  make_periodic(scene, 1);
  return scene;
}

// Mean error of the acceleration of component 0 for that velocity on n x n cells.
double mean_error(int n, bool limited) {
  const Tank s(periodic_square(n));
  const FaceField u = s.faces({u0, u1, [](const Vec3&) { return 0.0; }});
  Field a(s.grid);
  convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, 0, s.grid.all_cells(), limited,
                          a);
  double sum = 0.0;
  s.each_cell([&](int i, int j, int m, std::ptrdiff_t c) {
    const Vec3 x = s.face(0, i, j, m);
    const double expected = -u0(x) * k * std::cos(k * x[0]) * std::cos(k * x[1]) +
                            u1(x) * k * std::sin(k * x[0]) * std::sin(k * x[1]);
    sum += std::fabs(a[c] - expected);
  });
  return sum / (n * n);
}

TEST(Convection, OrderOnASmoothField) {
  const double upwind = std::log2(mean_error(64, false) / mean_error(128, false));
  const double limited = std::log2(mean_error(64, true) / mean_error(128, true));
  RecordProperty("upwind_order", std::to_string(upwind));
  RecordProperty("limited_order", std::to_string(limited));
  EXPECT_NEAR(upwind, 1.0, 0.1);
  EXPECT_GT(limited, 1.7);  // van Leer falls to first order at extrema: 2 only away from them
  EXPECT_LT(mean_error(64, true), 0.25 * mean_error(64, false));
}

// A flow and its mirror image must accelerate alike: both branches of the upwind choice are one formula.
TEST(Convection, MirroredFlowsAccelerateAlike) {
  const int n = 9;
  for (bool limited : {false, true}) {
    Tank s(unit_scene(2, n));
    FaceField u = s.random_faces(-1.0, 1.0), m(s.grid);
    const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
    s.each(s.grid.all_faces(0), [&](int i, int j, int, std::ptrdiff_t c) { m[0][c] = -u[0][at(n - i, j)]; });
    s.each(s.grid.all_faces(1),
           [&](int i, int j, int, std::ptrdiff_t c) { m[1][c] = u[1][at(n - 1 - i, j)]; });
    for (FaceField* v : {&u, &m}) s.boundary.fill_velocity(*v, Phase::fluid);
    for (int d : {0, 1}) {
      Field a(s.grid), b(s.grid);
      convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, d, s.grid.inner_faces(d),
                              limited, a);
      convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), m, d, s.grid.inner_faces(d),
                              limited, b);
      s.each(s.grid.inner_faces(d), [&](int i, int j, int, std::ptrdiff_t c) {
        EXPECT_NEAR(b[c], d == 0 ? -a[at(n - i, j)] : a[at(n - 1 - i, j)], 1e-12) << limited << d;
      });
    }
  }
}

// Limited in the heavy fluid, one-sided in the light one.
TEST(Convection, LimitedOnlyWhereTheFluidIsHeavy) {
  const int n = 16, surface = 8;
  const Tank s(periodic_square(n));
  const FaceField u = s.faces({u0, u1, [](const Vec3&) { return 0.0; }});
  Field mass(s.grid, 1.0), first(s.grid), second(s.grid), both(s.grid);
  s.each_cell([&](int, int j, int, std::ptrdiff_t c) { mass[c] = j < surface ? 1000.0 : 1.0; });
  s.boundary.exchange(mass);
  for (int d = 0; d < 2; ++d) {
    convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, d, s.grid.all_cells(), false,
                            first);
    convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, d, s.grid.all_cells(), true,
                            second);
    convective_acceleration_limited_in(mass, 31.6, s.grid, s.boundary.walls(), u, d, s.grid.all_cells(),
                                       both);
    double apart = 0.0;
    s.each_cell([&](int, int j, int, std::ptrdiff_t c) {
      EXPECT_EQ(both[c], j < surface ? second[c] : first[c]) << d << " row " << j;
      apart = std::fmax(apart, std::fabs(first[c] - second[c]));
    });
    EXPECT_GT(apart, 0.1);
  }
}

TEST(Convection, NoNewExtremumAtAStep) {
  for (bool limited : {false, true}) {
    for (double carrier : {1.0, -1.0}) {
      Scene scene = test::box_scene(2, {3, 40, 1}, {0.3, 4.0, 1.0});
      make_periodic(scene, 0);
      make_periodic(scene, 1);
      const Tank s(scene);
      FaceField u = s.faces({[](const Vec3& x) { return x[1] > 1.0 && x[1] < 2.0 ? 1.0 : 0.0; },
                             [=](const Vec3&) { return carrier; }, [](const Vec3&) { return 0.0; }});
      Field a(s.grid);
      const double dt = 0.4 * s.grid.h[1];
      const double before = s.total(u[0]);
      for (int step = 0; step < 60; ++step) {
        convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, 0, s.grid.all_cells(),
                                limited, a);
        s.each_cell([&](int, int, int, std::ptrdiff_t c) { u[0][c] += dt * a[c]; });
        s.boundary.exchange(u[0]);
        ASSERT_GE(s.smallest(u[0]), -1e-14);
        ASSERT_LE(s.largest(u[0]), 1.0 + 1e-14);
      }
      EXPECT_NEAR(s.total(u[0]), before, 1e-10);  // constant carrier: the advective form conserves
      EXPECT_LT(s.smallest(u[0]), 0.5);
      EXPECT_GT(s.largest(u[0]), 0.5);
    }
  }
}

// Few grains must not end a run: over ten cells a step no new extremum; where they count nothing changes.
TEST(Convection, BoundedWhereGrainsDoNotCount) {
  const double least = 1e-3, courant = 10.0;
  for (const int dim : {2, 3}) {
    for (const bool limited : {false, true}) {
      Scene scene = unit_scene(dim, 8);
      for (int d = 0; d < dim; ++d) make_periodic(scene, d);
      Tank s(scene);
      const FaceField u = s.random_faces(-1.0, 1.0);
      const double dt = courant * s.grid.h[0];
      Field fraction(s.grid);
      s.each_cell(
          [&](int i, int, int, std::ptrdiff_t c) { fraction[c] = i % 2 == 0 ? least : 0.99 * least; });
      double beyond = 0.0;
      for (int d = 0; d < dim; ++d) {
        Field free(s.grid), bounded(s.grid);
        convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, d, s.grid.all_cells(),
                                limited, free);
        bounded = free;
        bound_convection(s.grid, u, d, s.grid.all_cells(), dt, fraction, least, bounded);
        const double lowest = s.smallest(u[d]), highest = s.largest(u[d]);
        s.each_cell([&](int i, int, int, std::ptrdiff_t c) {
          if (i % 2 == 0) {
            EXPECT_EQ(bounded[c], free[c]);
            return;
          }
          EXPECT_GE(u[d][c] + dt * bounded[c], lowest - 1e-13);
          EXPECT_LE(u[d][c] + dt * bounded[c], highest + 1e-13);
          beyond = std::fmax(beyond, std::fabs(u[d][c] + dt * free[c]));
        });
      }
      EXPECT_GT(beyond, 5.0);  // without the bound
    }
  }
}

// Slow grains are not slowed further: below half a cell a step the acceleration is what it was.
TEST(Convection, BoundLeavesShortStepsAlone) {
  Tank s(periodic_square(8));
  const FaceField u = s.random_faces(-1.0, 1.0);
  Field free(s.grid), bounded(s.grid);
  convective_acceleration(unit_mass(s.grid), s.grid, s.boundary.walls(), u, 0, s.grid.all_cells(), false,
                          free);
  bounded = free;
  bound_convection(s.grid, u, 0, s.grid.all_cells(), 0.2 * s.grid.h[0], Field(s.grid), 1e-3, bounded);
  s.each_cell([&](int, int, int, std::ptrdiff_t c) { EXPECT_EQ(bounded[c], free[c]); });
}

}  // namespace
}  // namespace granvof
