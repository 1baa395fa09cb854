// Strain rate and explicit fluid viscosity on velocities whose derivatives are known.
#include <gtest/gtest.h>

#include "solver/operators/viscosity.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::Tank;
using test::unit_scene;
using Gradient = std::array<std::array<double, 3>, 3>;  // [component][direction]

FaceField linear_velocity(const Tank& s, const Gradient& g) {
  std::array<Tank::Function, 3> u;
  for (int d = 0; d < 3; ++d)
    u[d] = [g, d](const Vec3& x) { return 0.3 * d + g[d][0] * x[0] + g[d][1] * x[1] + g[d][2] * x[2]; };
  return s.faces(u);
}

void expect_exact(int dim, const Gradient& g) {
  const Tank s(unit_scene(dim, 4));
  StrainRate strain(s.grid);
  strain.update(s.grid, s.boundary.walls(), linear_velocity(s, g));
  double squared = 0.0, divergence = 0.0, normal = 0.0;
  for (int d = 0; d < dim; ++d) {
    divergence += g[d][d];
    normal += g[d][d] * g[d][d];
    for (int e = 0; e < dim; ++e) squared += std::pow(0.5 * (g[d][e] + g[e][d]), 2);
  }
  s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    EXPECT_NEAR(strain.squared[c], squared, 1e-12);
    EXPECT_NEAR(strain.normal_squared[c], normal, 1e-12);
    EXPECT_NEAR(strain.divergence[c], divergence, 1e-12);
  });
  for (int d = 0; d < dim; ++d)
    for (int e = d + 1; e < dim; ++e) {
      const int plane = plane_index(d, e);
      s.each(s.grid.edges(d, e), [&](int, int, int, std::ptrdiff_t c) {
        EXPECT_NEAR(strain.shear[plane][c], g[d][e] + g[e][d], 1e-12);
      });
      s.each_cell([&](int, int, int, std::ptrdiff_t c) {
        EXPECT_NEAR(strain.plane_squared[plane][c], 0.5 * std::pow(g[d][e] + g[e][d], 2), 1e-12);
      });
    }
}

TEST(StrainRate, PlanesHaveTheirOwnIndex) {
  EXPECT_EQ(plane_index(0, 1), 0);
  EXPECT_EQ(plane_index(0, 2), 1);
  EXPECT_EQ(plane_index(1, 2), 2);
}

TEST(StrainRate, ExactForLinearVelocities) {
  const Gradient pure_shear{{{0, 2, 0}, {0, 0, 0}, {0, 0, 0}}};
  const Gradient extension{{{1.5, 0, 0}, {0, -0.5, 0}, {0, 0, -1}}};
  const Gradient rotation{{{0, -3, 0}, {3, 0, 0}, {0, 0, 0}}};
  const Gradient any{{{0.3, -1.1, 0.7}, {2.0, -0.4, 0.2}, {-0.9, 1.3, 0.6}}};
  for (const Gradient& g : {pure_shear, extension, rotation, any})
    for (int dim : {2, 3}) expect_exact(dim, g);
}

// A floor of obstacles from one end of a period to the other is a no-slip floor: u = y above it, in every
// column.
TEST(StrainRate, AnObstacleOverTheEndsOfAPeriodIsAFloor) {
  Scene scene = unit_scene(2, 4);
  test::make_periodic(scene, 0);
  scene.obstacles = {{{0.0, 0.0, 0.0}, {1.0, 0.25, 1.0}}};
  const Tank s(scene);
  const auto above = [](const Vec3& x) { return std::max(x[1] - 0.25, 0.0); };
  const auto rest = [](const Vec3&) { return 0.0; };
  FaceField u = s.faces({above, rest, rest});
  s.boundary.fill_velocity(u, Phase::fluid);
  StrainRate strain(s.grid);
  strain.update(s.grid, s.boundary.walls(), u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(strain.squared[s.grid.cells.index(i, 1, 0)], 0.5, 1e-12) << i;
}

TEST(StrainRate, RotationShearsOnlyAtNoSlipWalls) {
  const Tank s(unit_scene(2, 6, WallKind::no_slip));
  FaceField u = linear_velocity(s, {{{0, -1, 0}, {1, 0, 0}, {0, 0, 0}}});
  s.boundary.fill_velocity(u, Phase::fluid);
  StrainRate strain(s.grid);
  strain.update(s.grid, s.boundary.walls(), u);
  s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
    const bool inside = i > 0 && i < 5 && j > 0 && j < 5;
    if (inside) {
      EXPECT_NEAR(strain.squared[c], 0.0, 1e-24);
    } else {
      EXPECT_GT(strain.squared[c], 1e-3);
    }
  });
}

// Acceleration of component d on inner faces away from the sides.
struct Viscous {
  explicit Viscous(Scene scene) : s(std::move(scene)), inertia(s.grid), viscosity(s.grid, s.scene) {}
  void update(const FaceField& u, const Field& f_s, const Field& alpha) {
    inertia.update(s.grid, s.scene, f_s, alpha);
    State state(s.grid);
    state.u_c = u;
    state.f_s = f_s;
    state.alpha = alpha;
    viscosity.update(s.boundary, state);
  }
  void expect(const FaceField& u, int d, const Tank::Function& expected, double tolerance) {
    Field a(s.grid);
    viscosity.add_acceleration(u, inertia, d, s.grid.inner_faces(d), a);
    const auto n = s.grid.cells.n;
    s.each(s.grid.inner_faces(d), [&](int i, int j, int k, std::ptrdiff_t c) {
      const std::array<int, 3> at{i, j, k};
      for (int e = 0; e < s.grid.dim; ++e)
        if (at[e] == 0 || at[e] + 1 >= n[e]) return;
      EXPECT_NEAR(a[c], expected(s.face(d, i, j, k)), tolerance) << d << ": " << i << ' ' << j << ' ' << k;
    });
  }
  Tank s;
  FaceInertia inertia;
  FluidViscosity viscosity;
};

Scene without_les(int dim) {
  Scene scene = unit_scene(dim, 6);
  scene.model.les = false;
  return scene;
}

TEST(FluidViscosity, ExactForQuadraticVelocities) {
  for (int dim : {2, 3}) {
    Viscous v(without_les(dim));
    const double nu = 1e-6;
    // divergence-free, grad u^T adds nothing: nu laplacian u
    const FaceField u = v.s.faces({[](const Vec3& x) { return x[0] * x[0] + 3.0 * x[1] * x[1]; },
                                   [](const Vec3& x) { return -2.0 * x[0] * x[1] + 0.5 * x[2] * x[2]; },
                                   [](const Vec3&) { return 1.0; }});
    for (double solid : {0.0, 0.4}) {  // a uniform solid fraction cancels
      v.update(u, v.s.cells([=](const Vec3&) { return solid; }), v.s.cells([](const Vec3&) { return 1.0; }));
      EXPECT_NEAR(v.viscosity.largest_kinematic(), nu, 1e-18);
      v.expect(
          u, 0, [=](const Vec3&) { return 8.0 * nu; }, 1e-14);
      v.expect(
          u, 1, [=](const Vec3&) { return dim == 3 ? nu : 0.0; }, 1e-14);
    }
    // u = x^2 alone: the transposed gradient doubles it, (mu 2 du/dx)' = 4 mu
    const FaceField w = v.s.faces({[](const Vec3& x) { return x[0] * x[0]; }, [](const Vec3&) { return 0.0; },
                                   [](const Vec3&) { return 0.0; }});
    v.update(w, v.s.cells([](const Vec3&) { return 0.0; }), v.s.cells([](const Vec3&) { return 1.0; }));
    v.expect(
        w, 0, [=](const Vec3&) { return 4.0 * nu; }, 1e-14);
  }
}

TEST(FluidViscosity, RigidMotionIsNotResisted) {
  for (bool les : {false, true}) {
    Scene scene = unit_scene(3, 6);
    scene.model.les = les;
    Viscous v(scene);
    const FaceField u = linear_velocity(v.s, {{{0, -3, 1}, {3, 0, -2}, {-1, 2, 0}}});
    v.update(u, v.s.cells([](const Vec3& x) { return 0.3 * x[0]; }),
             v.s.cells([](const Vec3& x) { return x[1]; }));
    for (int d = 0; d < 3; ++d)
      v.expect(
          u, d, [](const Vec3&) { return 0.0; }, 1e-12);
  }
}

TEST(FluidViscosity, SubgridViscosityOfAUniformShear) {
  const double shear = 4.0;
  for (int dim : {2, 3}) {
    for (bool les : {false, true}) {
      Scene scene = unit_scene(dim, 6);
      scene.model.les = les;
      Viscous v(scene);
      const FaceField u = linear_velocity(v.s, {{{0, shear, 0}, {0, 0, 0}, {0, 0, 0}}});
      v.update(u, v.s.cells([](const Vec3&) { return 0.2; }), v.s.cells([](const Vec3&) { return 1.0; }));
      const double delta = 1.0 / 6.0;
      EXPECT_NEAR(v.viscosity.largest_kinematic(), 1e-6 + (les ? std::pow(0.18 * delta, 2) * shear : 0.0),
                  1e-12);
      v.expect(
          u, 0, [](const Vec3&) { return 0.0; }, 1e-12);
    }
  }
}

TEST(FluidViscosity, GasBesideLiquidFeelsTheHarmonicMean) {
  Viscous v(without_les(2));
  const double shear = 2.0, mu_l = 1e-3, mu_g = 1e-5, h = 1.0 / 6.0;
  const FaceField u = linear_velocity(v.s, {{{0, shear, 0}, {0, 0, 0}, {0, 0, 0}}});
  v.update(u, v.s.cells([](const Vec3&) { return 0.0; }),
           v.s.cells([](const Vec3& x) { return x[1] < 0.5 ? 1.0 : 0.0; }));
  const double edge = 2.0 * mu_l * mu_g / (mu_l + mu_g) * shear;
  v.expect(
      u, 0,
      [=](const Vec3& x) {
        if (std::fabs(x[1] - (0.5 - 0.5 * h)) < 1e-9) return (edge - mu_l * shear) / h / 1000.0;
        if (std::fabs(x[1] - (0.5 + 0.5 * h)) < 1e-9) return (mu_g * shear - edge) / h / 1.0;
        return 0.0;
      },
      1e-12);
}

}  // namespace
}  // namespace granvof
