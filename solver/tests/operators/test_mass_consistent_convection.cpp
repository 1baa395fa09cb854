// Faces that a front reaches take up what it brings; others are left alone, and nothing new is made.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/operators/mass_consistent_convection.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::make_periodic;
using test::Tank;

constexpr double heavy = 1000.0, untouched = 1e9;
constexpr double dt = 0.01, h = 0.1;
constexpr int cells = 12, front = 6;  // the cells before `front` are full

// A body in a line of cells along e that moves into what is at rest, `thin` of its mass.
struct Arrival {
  Tank s;
  Field m;
  FaceField u;

  Arrival(int dim, int e, double speed, double across, double thin)
      : s(line(dim, e)),
        m(s.cells([=](const Vec3& x) { return behind(x[e], speed) ? heavy : thin * heavy; })),
        u(s.faces({moves(0, e, speed, across), moves(1, e, speed, across), moves(2, e, speed, across)})) {}

  static Scene line(int dim, int e) {
    std::array<int, 3> n{3, 3, dim == 3 ? 3 : 1};
    n[e] = cells;
    Scene scene = test::box_scene(dim, n, {h * n[0], h * n[1], h * n[2]});
    for (int d = 0; d < dim; ++d) make_periodic(scene, d);
    return scene;
  }
  // whichever way it moves, it moves out of its half of the line; its front face moves with it
  static bool behind(double x, double speed) {
    const double edge = h * front;
    return speed > 0.0 ? x < edge + 0.1 * h : x > edge - 0.1 * h;
  }
  static Tank::Function moves(int d, int e, double speed, double across) {
    return [=](const Vec3& x) { return behind(x[e], speed) ? (d == e ? speed : across) : 0.0; };
  }
  // Of component d, on the first faces along e on which nothing moves yet.
  std::ptrdiff_t first_at_rest(int d, int e, double speed) const {
    std::array<int, 3> i{1, 1, s.grid.dim == 3 ? 1 : 0};
    i[e] = speed > 0.0 ? front : front - 1;
    if (d == e) i[e] = speed > 0.0 ? front + 1 : front - 1;
    return s.grid.cells.index(i[0], i[1], i[2]);
  }
  double convect(int d, Field& a, bool limited = false) const {
    return convect_with_mass(m, limited, 0.0, s.grid, s.boundary.walls(), u, d, s.grid.inner_faces(d), dt, a);
  }
};

TEST(MassConsistentConvection, AnEmptyFaceTakesTheVelocityOfWhatArrives) {
  for (const int dim : {2, 3})
    for (int e = 0; e < dim; ++e)
      for (const double speed : {2.0, -2.0})
        for (int d = 0; d < dim; ++d) {
          const Arrival body(dim, e, speed, 3.0, 0.0);
          Field a(body.s.grid, untouched);
          body.convect(d, a);
          EXPECT_NEAR(dt * a[body.first_at_rest(d, e, speed)], d == e ? speed : 3.0, 1e-12)
              << dim << e << d << speed;
        }
}

TEST(MassConsistentConvection, AThinFaceSharesTheMomentum) {
  const double thin = 0.3, speed = 2.0, across = 3.0;
  for (const int d : {0, 1}) {
    const Arrival body(2, 0, speed, across, thin);
    Field a(body.s.grid, untouched);
    body.convect(d, a);
    // along: half of the front's flux, the other half of the control volume is at rest; across: all of it
    const double arrived = dt * (d == 0 ? 0.5 : 1.0) * heavy * speed / h;
    EXPECT_NEAR((thin * heavy + arrived) * dt * a[body.first_at_rest(d, 0, speed)],
                arrived * (d == 0 ? speed : across), 1e-9);
  }
}

TEST(MassConsistentConvection, NothingChangesWithinABodyAtOneSpeed) {
  for (const bool limited : {false, true}) {
    const Arrival body(2, 0, 2.0, 3.0, 0.0);
    for (const int d : {0, 1}) {
      Field a(body.s.grid, untouched);
      body.convect(d, a, limited);
      body.s.each_cell([&](int i, int, int, std::ptrdiff_t c) {
        if (i < front) {
          EXPECT_EQ(a[c], 0.0) << i;
        }
      });
    }
  }
}

TEST(MassConsistentConvection, NextToNothingIsNotSolvedFor) {
  const Arrival body(2, 0, 1e-8, 0.0, 0.0);  // 1e-9 of a cell in a step
  Field a(body.s.grid, untouched);
  body.convect(0, a);
  EXPECT_EQ(a[body.first_at_rest(0, 0, 1e-8)], 0.0);
}

Scene periodic(int dim, int n) {
  Scene scene = test::unit_scene(dim, n);
  for (int d = 0; d < dim; ++d) make_periodic(scene, d);
  return scene;
}

// A periodic box of random masses and velocities.
struct RandomBox {
  Tank s;
  FaceField u;
  Field m;

  explicit RandomBox(int dim) : s(periodic(dim, 8)), u(s.random_faces(-1.0, 1.0)), m(s.grid) {
    s.each_cell([&](int, int, int, std::ptrdiff_t c) { m[c] = s.uniform(0.0, 1.0) < 0.5 ? 1e-3 : 1.0; });
    s.boundary.exchange(m);
  }
  // Mass that comes into the control volume of a face per volume and time, by the same upwind fluxes.
  double filling(int d, std::ptrdiff_t c) const {
    double net = 0.0;
    for (int e = 0; e < s.grid.dim; ++e) {
      const std::ptrdiff_t t = s.grid.stride(e);
      const auto flux = [&](std::ptrdiff_t at) { return u[e][at] * (u[e][at] > 0.0 ? m[at - t] : m[at]); };
      for (const std::ptrdiff_t cell : {c, c - s.grid.stride(d)})
        net += 0.5 * (flux(cell) - flux(cell + t)) / s.grid.h[e];
    }
    return net;
  }
};

TEST(MassConsistentConvection, MomentumIsConserved) {
  for (const int dim : {2, 3})
    for (const bool limited : {false, true}) {
      const RandomBox box(dim);
      const double step = 0.02 * box.s.grid.h[0];
      for (int d = 0; d < dim; ++d) {
        Field a(box.s.grid, untouched);
        convect_with_mass(box.m, limited, 0.0, box.s.grid, box.s.boundary.walls(), box.u, d,
                          box.s.grid.all_cells(), step, a);
        double before = 0.0, after = 0.0, magnitude = 0.0;
        box.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
          const double old = 0.5 * (box.m[c] + box.m[c - box.s.grid.stride(d)]);
          before += old * box.u[d][c];
          after += (old + step * box.filling(d, c)) * (box.u[d][c] + step * a[c]);
          magnitude += old * std::fabs(box.u[d][c]);
        });
        EXPECT_NEAR(after, before, 1e-12 * magnitude) << dim << d << limited;
      }
    }
}

TEST(MassConsistentConvection, NoNewExtremumHoweverLongTheStep) {
  for (const int dim : {2, 3}) {
    const RandomBox box(dim);
    const double step = 10.0 * box.s.grid.h[0];
    for (int d = 0; d < dim; ++d) {
      Field a(box.s.grid, untouched);
      convect_with_mass(box.m, true, 0.0, box.s.grid, box.s.boundary.walls(), box.u, d,
                        box.s.grid.all_cells(), step, a);
      const double lowest = box.s.smallest(box.u[d]), highest = box.s.largest(box.u[d]);
      box.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
        EXPECT_GE(box.u[d][c] + step * a[c], lowest - 1e-12);
        EXPECT_LE(box.u[d][c] + step * a[c], highest + 1e-12);
      });
    }
  }
}

// Where grains have left for good their fraction ends among the smallest numbers there are.
TEST(MassConsistentConvection, OfNextToNothingIsFinite) {
  const RandomBox box(2);
  for (const double next_to_nothing : {1e-300, 1e-308, std::numeric_limits<double>::denorm_min()}) {
    FaceField u = box.u;
    u[1].fill(0.0);
    for (int d = 0; d < 2; ++d) {
      Field a(box.s.grid, untouched);
      convect_with_mass(Field(box.s.grid, next_to_nothing), true, 0.0, box.s.grid, box.s.boundary.walls(), u,
                        d, box.s.grid.all_cells(), 1e-3, a);
      box.s.each_cell([&](int, int, int, std::ptrdiff_t c) { EXPECT_TRUE(std::isfinite(a[c])) << a[c]; });
    }
  }
}

// Where a phase is alike everywhere and its flow keeps its volume, both forms are -(u . grad) u.
TEST(MassConsistentConvection, OrderOnASmoothFlow) {
  const auto error = [](int n, bool limited) {
    const Tank s(periodic(2, n));
    constexpr double k = 2.0 * std::numbers::pi;
    const auto u0 = [](const Vec3& x) { return 0.7 + std::sin(k * x[0]) * std::cos(k * x[1]); };
    const auto u1 = [](const Vec3& x) { return -0.4 - std::cos(k * x[0]) * std::sin(k * x[1]); };
    const FaceField u = s.faces({u0, u1, [](const Vec3&) { return 0.0; }});
    Field a(s.grid);
    convect_with_mass(Field(s.grid, 1.0), limited, 0.0, s.grid, s.boundary.walls(), u, 0, s.grid.all_cells(),
                      1e-6, a);
    double sum = 0.0;
    s.each_cell([&](int i, int j, int m, std::ptrdiff_t c) {
      const Vec3 x = s.face(0, i, j, m);
      sum += std::fabs(a[c] + u0(x) * k * std::cos(k * x[0]) * std::cos(k * x[1]) -
                       u1(x) * k * std::sin(k * x[0]) * std::sin(k * x[1]));
    });
    return sum / (n * n);
  };
  const double upwind = std::log2(error(64, false) / error(128, false));
  const double limited = std::log2(error(64, true) / error(128, true));
  RecordProperty("upwind_order", std::to_string(upwind));
  RecordProperty("limited_order", std::to_string(limited));
  EXPECT_NEAR(upwind, 1.0, 0.1);
  EXPECT_GT(limited, 1.7);
}

}  // namespace
}  // namespace granvof
