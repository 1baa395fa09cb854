// Implicit viscosity against the discrete modes it must damp: one number a mode, known exactly.
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "solver/operators/implicit_viscosity.hpp"
#include "solver/operators/viscosity.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof::test {
namespace {

constexpr double pi = std::numbers::pi;

// The operator on a full tank of liquid (mu = 1e-3, rho = 1000) without grains.
struct Implicit {
  explicit Implicit(Scene scene)
      : s(std::move(scene)),
        inertia(s.grid),
        viscosity(s.grid, s.scene),
        implicit(s.grid, s.scene, s.boundary),
        aperture(s.grid, s.scene),
        beta(s.grid),
        u_s(s.grid) {}
  // u_c after a step whose explicit part moved `old` by `increment`.
  FaceField after(double dt, const FaceField& old, const FaceField& increment, double alpha_below = 1.0,
                  double level = 2.0) {
    State now = s.uniform_state(f_s);
    now.alpha = s.cells([=](const Vec3& x) { return x[1] < level ? alpha_below : 0.0; });
    now.u_c = old;
    inertia.update(s.grid, s.scene, now.f_s, now.alpha);
    viscosity.update(s.boundary, now);
    FaceField u = old;
    for (int d = 0; d < s.grid.dim; ++d)
      s.each(s.grid.fluid_faces(d), [&](int, int, int, std::ptrdiff_t c) { u[d][c] += increment[d][c]; });
    const FaceField u_before = u, us_before = u_s;
    FaceField star = u;
    EXPECT_TRUE(implicit.apply(dt, viscosity.of_cells(), inertia, beta, aperture, old, star, u, u_s));
    // the predictor gains the whole impulse: what the grains took of it came through the fluid
    for (int d = 0; d < s.grid.dim; ++d)
      s.each(s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        const double fluid = inertia.fluid[d][c], grains = inertia.solid[d][c];
        const double impulse = fluid * (u[d][c] - u_before[d][c]) + grains * (u_s[d][c] - us_before[d][c]);
        EXPECT_NEAR(fluid * (star[d][c] - u_before[d][c]), impulse, 1e-9 * fluid);
      });
    return u;
  }
  Tank s;
  FaceInertia inertia;
  FluidViscosity viscosity;
  ImplicitViscosity implicit;
  Aperture aperture;
  FaceField beta, u_s;
  double f_s = 0.0;
};

Scene laminar(int dim, int n, WallKind kind) {
  Scene scene = unit_scene(dim, n, kind);
  scene.model.les = false;
  return scene;
}

const Tank::Function zero = [](const Vec3&) { return 0.0; };

// An increment u_x = mode(y) between two walls comes out divided by 1 + nu dt k_h^2, k_h = 2 sin(k h / 2) /
// h, however long the step: cos(pi y) between slip walls, sin(pi y) between no-slip walls (half a cell away:
// a mode of the ghost rule, too).
TEST(ImplicitViscosity, ShearModesBetweenWalls) {
  for (const WallKind kind : {WallKind::slip, WallKind::no_slip}) {
    for (const int dim : {2, 3}) {
      const int n = 12;
      Scene scene = laminar(dim, n, kind);
      make_periodic(scene, 0);
      if (dim == 3) make_periodic(scene, 2);
      Implicit v(scene);
      const auto mode = [=](const Vec3& x) {
        return kind == WallKind::slip ? std::cos(pi * x[1]) : std::sin(pi * x[1]);
      };
      const double h = 1.0 / n, k = 2.0 * std::sin(0.5 * pi * h) / h;
      for (const double number : {0.1, 10.0, 1e4}) {
        const double dt = number * h * h / 1e-6;
        const FaceField u = v.after(dt, v.s.faces({zero, zero, zero}), v.s.faces({mode, zero, zero}));
        const double left = 1.0 / (1.0 + 1e-6 * dt * k * k);
        v.s.each(v.s.grid.fluid_faces(0), [&](int i, int j, int l, std::ptrdiff_t c) {
          ASSERT_NEAR(u[0][c], left * mode(v.s.face(0, i, j, l)), 2e-5) << number;
        });
      }
    }
  }
}

// The normal part counts twice: u_x = sin(pi x) between closed ends is divided by 1 + 2 nu dt k_h^2.
TEST(ImplicitViscosity, NormalMode) {
  const int n = 12;
  Implicit v(laminar(2, n, WallKind::slip));
  const auto mode = [](const Vec3& x) { return std::sin(pi * x[0]); };
  const double h = 1.0 / n, k = 2.0 * std::sin(0.5 * pi * h) / h, dt = 10.0 * h * h / 1e-6;
  const FaceField u = v.after(dt, v.s.faces({zero, zero, zero}), v.s.faces({mode, zero, zero}));
  v.s.each(v.s.grid.fluid_faces(0), [&](int i, int j, int l, std::ptrdiff_t c) {
    ASSERT_NEAR(u[0][c], mode(v.s.face(0, i, j, l)) / (1.0 + 2e-6 * dt * k * k), 2e-5);
  });
}

// With drag both phases change, and the pair solves the coupled implicit step from any explicit one. One
// mode, grains of f_s = 0.5: m_c (c' - c*) = -f_c mu k_h^2 c' + beta (s' - c'), m_s (s' - s*) = beta (c' -
// s').
TEST(ImplicitViscosity, GrainsChangeWithTheFluidTheyDrag) {
  const int n = 12;
  Scene scene = laminar(2, n, WallKind::slip);
  make_periodic(scene, 0);
  Implicit v(scene);
  const double h = 1.0 / n, k = 2.0 * std::sin(0.5 * pi * h) / h, dt = 10.0 * h * h / 1e-6;
  const double m_c = 500.0 / dt, m_s = 1250.0 / dt, beta = 5.0 * m_c, resistance = 0.5 * 1e-3 * k * k;
  const double c_star = 1.0, s_star = -0.3;  // amplitudes of the predictors
  const auto solve = [&](double friction) {  // (c, s) of the 2x2 system, by Cramer's rule
    const double a = m_c + friction + beta, b = -beta, d = m_s + beta, det = a * d - b * b;
    return std::pair{(m_c * c_star * d - b * m_s * s_star) / det,
                     (a * m_s * s_star - b * m_c * c_star) / det};
  };
  const auto [c0, s0] = solve(0.0);  // the explicit step's own, drag implicit; u_c^n = 0
  const auto [c1, s1] = solve(resistance);
  const auto mode = [](const Vec3& x) { return std::cos(pi * x[1]); };
  v.f_s = 0.5;
  v.beta = v.s.faces({[=](const Vec3&) { return beta; }, zero, zero});
  v.u_s = v.s.faces({[=, s = s0](const Vec3& x) { return s * mode(x); }, zero, zero});
  const FaceField u = v.after(dt, v.s.faces({zero, zero, zero}),
                              v.s.faces({[=, c = c0](const Vec3& x) { return c * mode(x); }, zero, zero}));
  v.s.each(v.s.grid.fluid_faces(0), [&, c = c1, s = s1](int i, int j, int l, std::ptrdiff_t at) {
    ASSERT_NEAR(u[0][at], c * mode(v.s.face(0, i, j, l)), 2e-5);
    ASSERT_NEAR(v.u_s[0][at], s * mode(v.s.face(0, i, j, l)), 2e-5);
  });
}

// What the explicit terms hold steady stays, and a uniform increment through an open top (gas above liquid)
// is not resisted.
TEST(ImplicitViscosity, NothingToDampStays) {
  Scene scene = laminar(2, 12, WallKind::slip);
  scene.sides[top].kind = SideKind::open;
  Implicit v(scene);
  const FaceField old = v.s.faces({[](const Vec3& x) { return std::sin(7.0 * x[1]) * std::sin(pi * x[0]); },
                                   [](const Vec3& x) { return x[1] * std::cos(3.0 * x[0]); }, zero});
  const FaceField same = v.after(1e6, old, v.s.faces({zero, zero, zero}), 1.0, 0.5);
  for (int d = 0; d < 2; ++d)
    v.s.each(v.s.grid.fluid_faces(d),
             [&](int, int, int, std::ptrdiff_t c) { ASSERT_EQ(same[d][c], old[d][c]); });
  // du_y = y: its only resistance is the normal stress, which a linear velocity keeps constant within one
  // fluid
  const FaceField rise = v.s.faces({zero, [](const Vec3&) { return 1.0; }, zero});
  const FaceField risen = v.after(1e3, v.s.faces({zero, zero, zero}), rise, 0.0, 0.5);
  const std::ptrdiff_t middle = v.s.grid.cells.index(6, 12, 0);
  EXPECT_GT(risen[1][middle], 0.5);  // the floor holds it below, the open top does not
  EXPECT_GT(risen[1][middle], risen[1][v.s.grid.cells.index(6, 11, 0)]);
}

// A closed gate is a wall that the increment vanishes at: nothing passes, and what is beside it is held.
TEST(ImplicitViscosity, ClosedGate) {
  Scene scene = laminar(2, 12, WallKind::slip);
  scene.gate = Gate{0.5, 1.0};
  Implicit v(scene);
  const auto one = [](const Vec3&) { return 1.0; };
  FaceField push = v.s.faces({one, zero, zero});
  const int face = 6;
  for (int j = 0; j < 12; ++j) push[0][v.s.grid.cells.index(face, j, 0)] = 0.0;
  const FaceField u = v.after(1e4, v.s.faces({zero, zero, zero}), push);
  for (int j = 0; j < 12; ++j) {
    EXPECT_EQ(u[0][v.s.grid.cells.index(face, j, 0)], 0.0);
    EXPECT_LT(u[0][v.s.grid.cells.index(face + 1, j, 0)], 0.7);
  }
}

}  // namespace
}  // namespace granvof::test
