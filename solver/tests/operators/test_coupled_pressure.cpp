// The coupled pressure step: continuity and the pressure law after it, hydrostatics, and starts that are
// hard.
#include <gtest/gtest.h>

#include "solver/closures/point_on_law.hpp"
#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/operators/coupled_pressure.hpp"
#include "solver/operators/interphase_drag.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/operators/tank.hpp"
#include "solver/tests/solid_pressure_of_paper.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::make_periodic;
using test::Tank;
using test::unit_scene;

// One pressure step from a state given by its fields.
struct Step {
  explicit Step(Scene given)
      : s(std::move(given)),
        aperture(s.grid, s.scene),
        state(s.uniform_state(0.0)),
        rheology(s.grid),
        flux_s(s.grid),
        flux_c(s.grid),
        inertia(s.grid),
        beta(s.grid) {
    rheology.restitution.fill(0.9);
  }
  void solve(double dt) {
    s.boundary.fill_scalar(f_s, 0.0);
    s.boundary.fill_scalar(alpha, 0.0);
    inertia.update(s.grid, s.scene, f_s, alpha);
    InterphaseDrag drag(s.grid, s.scene);
    drag.update(s.boundary, state, inertia, rheology);
    beta = drag.beta();
    for (int d = 0; d < s.grid.dim; ++d)  // where there are no grains both move as one from the start
      s.each(s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        if (inertia.f_s[d][c] < least_solid_fraction) u_s[d][c] = u_c[d][c];
      });
    const closures::SolidLaw of_scene(s.scene);
    CoupledPressure pressure(s.grid, s.scene, s.boundary, of_scene);
    const State now = state;
    report = pressure.solve(dt, now, rheology, inertia, beta, aperture, state, flux_s, flux_c);
  }
  // Both velocities after a time dt of free fall.
  void fall(double dt) {
    s.each(s.grid.fluid_faces(1), [&](int, int, int, std::ptrdiff_t c) { u_c[1][c] = -9.81 * dt; });
    s.each(s.grid.inner_faces(1), [&](int, int, int, std::ptrdiff_t c) { u_s[1][c] = -9.81 * dt; });
  }
  double solid_after(double dt, std::ptrdiff_t c) const { return f_s[c] - dt * s.divergence(flux_s, c); }
  closures::PressureAndSlope law(double f, std::ptrdiff_t c) const {
    return test::solid_pressure(std::fmax(f, 0.0), theta[c], rheology.restitution[c], s.scene.solid.density,
                                s.scene.contact, s.scene.model.dense_excess);
  }
  // Continuity and the law in every cell, recomputed from the fluxes that came out.
  void expect_closed(double dt) const {
    ASSERT_TRUE(report.converged) << report.newton << ' ' << report.mismatch << ' ' << report.divergence;
    const double tolerance = s.scene.numerics.volume_tolerance;
    s.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
      EXPECT_LE(std::fabs(s.divergence(flux_s, c) + s.divergence(flux_c, c)) * dt, 1.01 * tolerance + 1e-12);
      const double f = solid_after(dt, c);
      const auto p = law(f, c);
      EXPECT_LE(std::fabs(p.value - p_s[c]) / std::fmax(p.slope, 10.0 * scales_of(s.scene).pressure),
                1.01 * tolerance)
          << i << ' ' << j << ' ' << k << ": " << f << ' ' << p.value << ' ' << p_s[c];
      EXPECT_GE(p_s[c], 0.0);
    });
  }
  Tank s;
  Aperture aperture;
  State state;
  Field &f_s = state.f_s, &alpha = state.alpha, &theta = state.theta, &p_c = state.p_c, &p_s = state.p_s;
  FaceField &u_s = state.u_s, &u_c = state.u_c;
  Rheology rheology;
  FaceField flux_s, flux_c;
  FaceInertia inertia;
  FaceField beta;  // drag of the step [kg/(m3 s)]
  PressureReport report;
};

Scene strict(Scene scene) {
  scene.numerics.volume_tolerance = 1e-13;
  scene.numerics.linear_tolerance = 1e-8;
  return scene;
}

TEST(CoupledPressure, WaterAtRestIsHydrostatic) {
  for (bool open : {true, false}) {
    Scene scene = strict(unit_scene(2, 8));
    if (open) scene.sides[top].kind = SideKind::open;
    Step step(scene);
    const double dt = 1e-3, h = 0.125;
    step.s.each_cell([&](int, int j, int, std::ptrdiff_t c) { step.alpha[c] = j < 5 ? 1.0 : 0.0; });
    step.fall(dt);
    step.solve(dt);
    step.expect_closed(dt);
    const auto& l = step.s.grid.cells;
    // density of a face is the mean of its cells; P = 0 on the open top, or free in a closed box
    const double reference = step.p_c[l.index(0, 7, 0)];
    if (open) {
      EXPECT_NEAR(reference, 1.0 * 9.81 * 0.5 * h, 1e-6);
    }
    step.s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
      double expected = reference;
      for (int b = 6; b >= j; --b) expected += 9.81 * h * (b > 4 ? 1.0 : (b == 4 ? 500.5 : 1000.0));
      EXPECT_NEAR(step.p_c[c], expected, 1e-6 * 5000.0) << i << ' ' << j;
      EXPECT_EQ(step.p_s[c], 0.0);
    });
    for (int d : {0, 1})
      step.s.each(step.s.grid.all_faces(d),
                  [&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(step.u_c[d][c], 0.0, 1e-10); });
  }
}

TEST(CoupledPressure, ClosesBothBalancesFromRandomStates) {
  for (int dim : {2, 3})
    for (const char* kind : {"open", "closed", "periodic"})
      for (SlopeLimiter flux :
           {SlopeLimiter::of<closures::LimiterNone>(), SlopeLimiter::of<closures::LimiterVanLeer>()})
        for (double density : {50.0, 200.0, 2500.0}) {
          Scene scene = unit_scene(dim, 8);
          scene.numerics.transport_scheme = flux;
          scene.solid.density = density;
          if (kind[0] == 'o') scene.sides[top].kind = SideKind::open;
          if (kind[0] == 'p') make_periodic(scene, 0);
          SCOPED_TRACE(std::string(kind) + " " + std::to_string(dim) + " " + std::to_string(density));
          Step step(scene);
          step.f_s = step.s.random_cells(0.0, 0.6);
          step.alpha = step.s.random_cells(0.0, 1.0);
          step.theta = step.s.random_cells(0.0, 1e-3);
          step.u_s = step.s.random_faces(-1.0, 1.0);
          step.u_c = step.s.random_faces(-1.0, 1.0);
          step.solve(5e-3);
          step.expect_closed(5e-3);
        }
}

// What the pressures and the drag do to both velocities on a face is the momentum balance of each phase:
//   m_s du_s = -f_s dt grad P_c - dt grad P_s - beta dt (du_s - du_c),
//   m_c du_c = -f_c dt grad P_c + beta dt (du_s - du_c).
TEST(CoupledPressure, BothVelocitiesKeepTheirMomentumBalance) {
  for (int dim : {2, 3}) {
    Step step(strict(unit_scene(dim, 6)));
    const double dt = 2e-3;
    step.f_s = step.s.random_cells(0.2, 0.5);
    step.alpha = step.s.random_cells(0.0, 1.0);
    step.theta = step.s.random_cells(0.1, 0.2);  // P_s > 0 everywhere
    step.u_s = step.s.random_faces(-0.5, 0.5);
    step.u_c = step.s.random_faces(-0.5, 0.5);
    const FaceField predicted_s = step.u_s, predicted_c = step.u_c;
    step.solve(dt);
    ASSERT_TRUE(step.report.converged);
    for (int d = 0; d < dim; ++d) {
      const std::ptrdiff_t below = step.s.grid.stride(d);
      const double dt_h = dt / step.s.grid.h[d];
      step.s.each(step.s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        const double f = step.inertia.f_s[d][c];
        const double du_s = step.u_s[d][c] - predicted_s[d][c], du_c = step.u_c[d][c] - predicted_c[d][c];
        const double push_c = dt_h * (step.p_c[c] - step.p_c[c - below]),
                     push_s = dt_h * (step.p_s[c] - step.p_s[c - below]),
                     drag = step.beta[d][c] * dt * (du_s - du_c);
        const double size = std::fabs(push_c) + std::fabs(push_s) + std::fabs(drag);
        ASSERT_GT(std::fabs(push_s), 0.0);
        EXPECT_NEAR(step.inertia.solid[d][c] * du_s, -f * push_c - push_s - drag, 1e-9 * size);
        EXPECT_NEAR(step.inertia.fluid[d][c] * du_c, -(1.0 - f) * push_c + drag, 1e-9 * size);
      });
    }
  }
}

TEST(CoupledPressure, NoGrainsAtAll) {
  Step step(unit_scene(2, 8));
  step.u_c = step.s.random_faces(-1.0, 1.0);
  step.solve(1e-2);
  step.expect_closed(1e-2);
  for (int d : {0, 1})
    step.s.each(step.s.grid.all_faces(d),
                [&](int, int, int, std::ptrdiff_t c) { EXPECT_EQ(step.flux_s[d][c], 0.0); });
}

// Grains that fall on the floor at 1 m/s: without P_s the lowest cell would reach 0.55 + 0.55 * 0.5.
TEST(CoupledPressure, CompressionStopsAtTheLaw) {
  for (bool drag : {true, false}) {
    Scene scene = box_scene(2, {1, 10, 1}, {0.01, 0.1, 1.0});
    scene.sides[top].kind = SideKind::open;
    scene.model.drag = drag;
    Step step(scene);
    const double dt = 5e-3;
    step.s.each_cell([&](int, int j, int, std::ptrdiff_t c) { step.f_s[c] = j < 6 ? 0.55 : 0.0; });
    step.s.each(step.s.grid.inner_faces(1), [&](int, int j, int, std::ptrdiff_t c) {
      if (j <= 6) step.u_s[1][c] = -1.0;
    });
    step.solve(dt);
    step.expect_closed(dt);
    const double lowest = step.solid_after(dt, step.s.grid.cells.index(0, 0, 0));
    EXPECT_GT(lowest, drag ? 0.55 : 0.57);
    EXPECT_LT(lowest, 0.63);
    if (!drag) {
      EXPECT_GT(step.p_s[step.s.grid.cells.index(0, 0, 0)], 100.0);
    }
  }
}

// A column far denser than its weight can hold: the elastic pressure is a thousand times the weight.
TEST(CoupledPressure, DenseStartsConverge) {
  for (double density : {50.0, 200.0, 910.0, 2500.0})
    for (double dt : {1e-5, 1e-3, 5e-3}) {
      SCOPED_TRACE(std::to_string(density) + " " + std::to_string(dt));
      Scene scene = box_scene(2, {16, 16, 1}, {0.08, 0.08, 1.0});
      scene.sides[top].kind = SideKind::open;
      scene.solid.density = density;
      Step step(scene);
      step.s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
        step.f_s[c] = i < 8 && j < 10 ? 0.61 : 0.0;
        step.alpha[c] = j < 13 ? 1.0 : 0.0;
      });
      step.fall(dt);
      step.solve(dt);
      step.expect_closed(dt);
      EXPECT_LE(step.report.newton, scene.numerics.newton_max);
    }
}

TEST(CoupledPressure, SaysWhenItDidNotConverge) {
  Scene scene = box_scene(2, {16, 16, 1}, {0.08, 0.08, 1.0});
  scene.numerics.newton_max = 1;
  Step step(scene);
  step.s.each_cell([&](int i, int j, int, std::ptrdiff_t c) { step.f_s[c] = i < 8 && j < 10 ? 0.61 : 0.0; });
  step.fall(1e-3);
  step.solve(1e-3);
  EXPECT_FALSE(step.report.converged);
  EXPECT_GT(step.report.mismatch, scene.numerics.volume_tolerance);
}

TEST(CoupledPressure, TheStandingGateIsTight) {
  Scene scene = box_scene(2, {16, 8, 1}, {0.16, 0.08, 1.0});
  scene.sides[top].kind = SideKind::open;
  scene.gate = Gate{0.08, 1.0};
  Step step(scene);
  step.aperture.update(0.03);  // three rows are open
  step.f_s = step.s.random_cells(0.0, 0.55);
  step.u_s = step.s.random_faces(-1.0, 1.0);
  step.u_c = step.s.random_faces(-1.0, 1.0);
  const auto gate = [&](int j) { return step.s.grid.cells.index(8, j, 0); };
  for (int j = 3; j < 8; ++j)
    step.u_s[0][gate(j)] = step.u_c[0][gate(j)] = 0.0;  // as the predictor leaves it
  step.solve(1e-3);
  step.expect_closed(1e-3);
  for (int j = 0; j < 8; ++j) {
    EXPECT_EQ(step.flux_s[0][gate(j)] == 0.0, j >= 3) << j;
    EXPECT_EQ(step.flux_c[0][gate(j)] == 0.0, j >= 3) << j;
  }
}

TEST(PointOnLaw, AgreesWithBisection) {
  Tank s(unit_scene(2, 2));
  const Contact contact;
  for (int i = 0; i < 3000; ++i) {
    const double theta = s.uniform(0.0, 1.0) < 0.5 ? 0.0 : std::pow(10.0, s.uniform(-8.0, 0.0));
    const auto law = [&](double f) { return test::solid_pressure(f, theta, 0.8, 2500.0, contact, true); };
    const double f_line = s.uniform(-0.2, 1.0), compliance = std::pow(10.0, s.uniform(-12.0, -2.0));
    const double p_line = (s.uniform(0.0, 1.0) < 0.3 ? -1.0 : 1.0) * std::pow(10.0, s.uniform(-2.0, 6.0));
    const auto off = [&](double f) { return f - f_line + compliance * (law(f).value - p_line); };
    double low = 0.0, high = 0.9;
    if (off(low) >= 0.0) {
      high = low;
    } else if (off(high) <= 0.0) {
      low = high;
    }
    for (int n = 0; n < 80; ++n) {
      const double middle = 0.5 * (low + high);
      (off(middle) > 0.0 ? high : low) = middle;
    }
    ASSERT_NEAR(closures::point_on_law(law, f_line, p_line, compliance), low, 1.1e-8)
        << f_line << ' ' << p_line << ' ' << compliance << ' ' << theta;
  }
}

}  // namespace
}  // namespace granvof
