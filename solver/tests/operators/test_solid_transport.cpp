// Solid volume balance: conservation, bounds, symmetry, order, and fluxes limited to what a cell holds.
#include <numbers>

#include <gtest/gtest.h>

#include "solver/operators/solid_fraction_flux.hpp"
#include "solver/operators/solid_transport.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::make_periodic;
using test::Tank;
using test::unit_scene;

using closures::LimiterNone;
using closures::LimiterSuperbee;
using closures::LimiterVanLeer;

constexpr std::array schemes{SlopeLimiter::of<LimiterNone>(), SlopeLimiter::of<LimiterVanLeer>(),
                             SlopeLimiter::of<LimiterSuperbee>()};

FaceField flux_of(const Tank& s, SlopeLimiter scheme, const Field& f, const FaceField& u, double dt) {
  const SolidFractionFlux fraction(scheme);
  FaceField flux(s.grid);
  for (int d = 0; d < s.grid.dim; ++d) {
    fraction.face_values(s.grid, s.boundary.walls(), f, u[d], d, dt, s.grid.inner_faces(d), flux[d]);
    s.each(s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) { flux[d][c] *= u[d][c]; });
    s.boundary.exchange(flux[d]);
  }
  return flux;
}

TEST(SolidTransport, ConservesToRounding) {
  for (int dim : {2, 3})
    for (SlopeLimiter scheme : schemes)
      for (bool periodic : {false, true}) {
        Scene scene = unit_scene(dim, 8);
        if (periodic) make_periodic(scene, 0);
        Tank s(scene);
        const Field f = s.random_cells(0.1, 0.6);
        Field f_new(s.grid);
        transport_solid(s.grid, 0.01, f, flux_of(s, scheme, f, s.random_faces(-1.0, 1.0), 0.01), f_new);
        EXPECT_NEAR(s.total(f_new), s.total(f), 1e-13 * s.total(f));
      }
}

// A pulse carried once around a periodic line; returns the mean error against where it began.
double carried_once(int n, SlopeLimiter scheme, double courant, double speed, bool step) {
  Scene scene = box_scene(2, {n, 1, 1}, {1.0, 1.0, 1.0});
  make_periodic(scene, 0);
  const Tank s(scene);
  const Field start = s.cells([=](const Vec3& x) {
    if (step) return x[0] > 0.25 && x[0] < 0.5 ? 0.6 : 0.1;
    return 0.3 + 0.2 * std::sin(2.0 * std::numbers::pi * x[0]);
  });
  Field f = start, f_new(s.grid);
  const FaceField u(s.grid, speed);
  FaceField flux(s.grid);
  const double dt = courant / n / std::fabs(speed);
  const int steps = static_cast<int>(std::lround(n / courant));
  const SolidFractionFlux fraction(scheme);
  for (int i = 0; i < steps; ++i) {
    fraction.face_values(s.grid, s.boundary.walls(), f, u[0], 0, dt, s.grid.inner_faces(0), flux[0]);
    s.each_cell([&](int, int, int, std::ptrdiff_t c) { flux[0][c] *= speed; });
    s.boundary.exchange(flux[0]);
    transport_solid(s.grid, dt, f, flux, f_new);
    f = f_new;
    s.boundary.fill_scalar(f);
    EXPECT_GE(s.smallest(f), s.smallest(start) - 1e-14);
    EXPECT_LE(s.largest(f), s.largest(start) + 1e-14);
  }
  double error = 0.0;
  s.each_cell([&](int, int, int, std::ptrdiff_t c) { error += std::fabs(f[c] - start[c]); });
  return error / n;
}

TEST(SolidTransport, StaysWithinBoundsAtEveryCourantNumber) {
  for (SlopeLimiter scheme : schemes)
    for (double courant : {0.1, 0.5, 0.8, 1.0})
      for (double speed : {2.0, -2.0}) {
        const double error = carried_once(40, scheme, courant, speed, true);
        if (courant == 1.0) {
          EXPECT_NEAR(error, 0.0, 1e-12);
        }  // a whole cell a step is exact
      }
}

TEST(SolidTransport, OrderOnASmoothPulse) {
  const auto order = [](SlopeLimiter scheme, double speed) {
    return std::log2(carried_once(64, scheme, 0.4, speed, false) /
                     carried_once(128, scheme, 0.4, speed, false));
  };
  for (double speed : {1.0, -1.0}) {
    EXPECT_NEAR(order(SlopeLimiter::of<LimiterNone>(), speed), 1.0, 0.1);
    EXPECT_GT(order(SlopeLimiter::of<LimiterVanLeer>(), speed), 1.7);
  }
}

TEST(SolidTransport, CompressiveFluxKeepsAStep) {
  for (double speed : {1.0, -1.0}) {
    const auto error = [=](int n, SlopeLimiter scheme) { return carried_once(n, scheme, 0.4, speed, true); };
    EXPECT_LT(error(80, SlopeLimiter::of<LimiterSuperbee>()),
              0.6 * error(80, SlopeLimiter::of<LimiterVanLeer>()));
    EXPECT_LT(error(160, SlopeLimiter::of<LimiterSuperbee>()),
              0.55 * error(80, SlopeLimiter::of<LimiterSuperbee>()));
  }
}

TEST(SolidTransport, MirroredStatesGiveMirroredFluxes) {
  const int n = 9;
  for (SlopeLimiter scheme : schemes) {
    Tank s(box_scene(2, {n, 4, 1}, {0.9, 0.4, 1.0}));
    const Field f = s.random_cells(0.0, 0.6);
    FaceField u = s.random_faces(-1.0, 1.0);
    u[0][s.grid.cells.index(4, 2, 0)] = 0.0;
    Field f_mirror(s.grid);
    FaceField u_mirror(s.grid);
    const auto at = [&](int i, int j) { return s.grid.cells.index(i, j, 0); };
    s.each_cell([&](int i, int j, int, std::ptrdiff_t c) { f_mirror[c] = f[at(n - 1 - i, j)]; });
    s.boundary.fill_scalar(f_mirror);
    s.each(s.grid.all_faces(0),
           [&](int i, int j, int, std::ptrdiff_t c) { u_mirror[0][c] = -u[0][at(n - i, j)]; });
    s.each(s.grid.all_faces(1),
           [&](int i, int j, int, std::ptrdiff_t c) { u_mirror[1][c] = u[1][at(n - 1 - i, j)]; });
    const FaceField q = flux_of(s, scheme, f, u, 0.01), m = flux_of(s, scheme, f_mirror, u_mirror, 0.01);
    s.each(s.grid.inner_faces(0),
           [&](int i, int j, int, std::ptrdiff_t c) { EXPECT_EQ(m[0][c], -q[0][at(n - i, j)]); });
    s.each(s.grid.inner_faces(1),
           [&](int i, int j, int, std::ptrdiff_t c) { EXPECT_EQ(m[1][c], q[1][at(n - 1 - i, j)]); });
  }
}

TEST(KeepSolidPositive, LeavesFluxesAloneThatCellsCanGive) {
  Tank s(unit_scene(2, 6));
  const Field f = s.random_cells(0.2, 0.6);
  const FaceField flux = flux_of(s, SlopeLimiter::of<LimiterNone>(), f, s.random_faces(-1.0, 1.0), 0.01);
  FaceField solid = flux, fluid = s.random_faces(-1.0, 1.0);
  const FaceField fluid_before = fluid;
  keep_solid_positive(s.grid, s.boundary, 0.01, f, solid, fluid);
  for (int d = 0; d < 2; ++d)
    s.each(s.grid.all_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      EXPECT_EQ(solid[d][c], flux[d][c]);
      EXPECT_EQ(fluid[d][c], fluid_before[d][c]);
    });
}

TEST(KeepSolidPositive, OverdrainedCellsRunEmptyAndTheTotalFluxStays) {
  for (bool periodic : {false, true}) {
    Scene scene = unit_scene(2, 8);
    if (periodic) make_periodic(scene, 0);
    Tank s(scene);
    const Field f = s.random_cells(0.0, 0.3);
    const double dt = 0.1;  // fluxes drain many cells several times over
    FaceField solid = s.random_faces(-0.3, 0.3), fluid = s.random_faces(-1.0, 1.0);
    const FaceField solid_before = solid, fluid_before = fluid;
    Field f_new(s.grid);
    transport_solid(s.grid, dt, f, solid, f_new);
    ASSERT_LT(s.smallest(f_new), -0.05);
    keep_solid_positive(s.grid, s.boundary, dt, f, solid, fluid);
    transport_solid(s.grid, dt, f, solid, f_new);
    EXPECT_GE(s.smallest(f_new), -1e-16);
    EXPECT_NEAR(s.total(f_new), s.total(f), 1e-13 * s.total(f));
    for (int d = 0; d < 2; ++d)
      s.each(s.grid.all_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        EXPECT_NEAR(solid[d][c] + fluid[d][c], solid_before[d][c] + fluid_before[d][c], 1e-15);
        EXPECT_GE(solid[d][c] * solid_before[d][c], 0.0);
        EXPECT_LE(std::fabs(solid[d][c]), std::fabs(solid_before[d][c]));
      });
  }
}

TEST(KeepSolidPositive, ARoundingErrorBelowZeroWithoutOutflowIsNoNan) {
  Tank s(box_scene(2, {4, 1, 1}, {0.4, 0.1, 1.0}));
  Field f = s.random_cells(0.3, 0.3);
  f[s.grid.cells.index(1, 0, 0)] = -1e-20;
  s.boundary.fill_scalar(f);
  FaceField solid(s.grid), fluid(s.grid);
  solid[0][s.grid.cells.index(3, 0, 0)] = 10.0;  // so that limiting happens at all: cell 2 is overdrained
  keep_solid_positive(s.grid, s.boundary, 0.1, f, solid, fluid);
  for (int i = 0; i <= 4; ++i) {
    EXPECT_TRUE(std::isfinite(solid[0][s.grid.cells.index(i, 0, 0)])) << i;
    EXPECT_TRUE(std::isfinite(fluid[0][s.grid.cells.index(i, 0, 0)])) << i;
  }
  EXPECT_NEAR(solid[0][s.grid.cells.index(3, 0, 0)], 0.3, 1e-15);  // all it holds: 0.3 * 0.1 m / 0.1 s
  EXPECT_NEAR(fluid[0][s.grid.cells.index(3, 0, 0)], 9.7, 1e-14);
}

TEST(Colour, UniformStaysUniformAndShareOfGrainsIsConserved) {
  Tank s(unit_scene(2, 8));
  const Field f = s.random_cells(0.2, 0.5);
  const FaceField flux = flux_of(s, SlopeLimiter::of<LimiterNone>(), f, s.random_faces(-1.0, 1.0), 0.02);
  Field f_new(s.grid), phi = s.random_cells(0.7, 0.7), phi_new(s.grid);
  transport_solid(s.grid, 0.02, f, flux, f_new);
  transport_with_grains(s.grid, 0.02, f, f_new, flux, phi, phi_new);
  s.each_cell([&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(phi_new[c], 0.7, 1e-14); });

  phi = s.random_cells(0.0, 1.0);
  transport_with_grains(s.grid, 0.02, f, f_new, flux, phi, phi_new);
  EXPECT_GE(s.smallest(phi_new), 0.0);
  EXPECT_LE(s.largest(phi_new), 1.0);
  double before = 0.0, after = 0.0, moved = 0.0;
  s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    before += f[c] * phi[c];
    after += f_new[c] * phi_new[c];
    moved = std::fmax(moved, std::fabs(phi_new[c] - phi[c]));
  });
  EXPECT_NEAR(after, before, 1e-13 * before);
  EXPECT_GT(moved, 0.01);
}

TEST(Colour, KeepsItsValueWhereNoGrainsAreLeft) {
  Tank s(unit_scene(2, 4));
  const Field f(s.grid, 0.0), phi = s.random_cells(0.4, 0.4);
  Field phi_new(s.grid);
  transport_with_grains(s.grid, 0.02, f, f, FaceField(s.grid), phi, phi_new);
  s.each_cell([&](int, int, int, std::ptrdiff_t c) { EXPECT_EQ(phi_new[c], 0.4); });
}

TEST(OutflowCourant, ShareOfTheContentThatLeaves) {
  Tank s(box_scene(2, {4, 3, 1}, {0.4, 0.3, 1.0}));
  Field f(s.grid, 0.5);
  FaceField flux(s.grid);
  const std::ptrdiff_t c = s.grid.cells.index(1, 1, 0);
  flux[0][c] = -0.2;                    // out of (1, 1) to the left
  flux[0][c + s.grid.stride(0)] = 0.1;  // and to the right
  flux[1][c] = 0.4;                     // into it from below, out of (1, 0)
  const double dt = 0.05;
  EXPECT_DOUBLE_EQ(outflow_courant(s.grid, dt, f, false, 1e-3, flux), dt * 0.4 / 0.1 / 0.5);
  f[s.grid.cells.index(1, 0, 0)] = 0.9;
  EXPECT_DOUBLE_EQ(outflow_courant(s.grid, dt, f, false, 1e-3, flux), dt * 0.3 / 0.1 / 0.5);
  EXPECT_DOUBLE_EQ(outflow_courant(s.grid, dt, f, true, 0.0, flux), dt * 0.4 / 0.1 / (1.0 - 0.9));
  EXPECT_EQ(outflow_courant(s.grid, dt, f, false, 1.0, flux), 0.0);  // nothing holds more than 1
}

}  // namespace
}  // namespace granvof
