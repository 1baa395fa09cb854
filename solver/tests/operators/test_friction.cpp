// Implicit solid stress: against the minimum of its own energy, assembled strain by strain and solved
// densely, and against exact states (rigid motion, steady shear, slip and Coulomb walls).
#include <map>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "solver/closures/contact_friction.hpp"
#include "solver/tests/operators/friction_bed.hpp"

namespace granvof {
namespace {

using test::Bed;
using test::box_scene;
using test::Layer;
using test::make_periodic;
using test::step;
using test::Tank;

// Half of sum V (2 mu sum (du_d/dx_d)^2 + lambda (div u)^2 + mu_edge (du_d/dx_e + du_e/dx_d)^2): one
// quadratic form a strain, each a short row over the unknown faces plus a constant from the known ones.
class Energy {
 public:
  explicit Energy(const Bed& bed) : bed_(bed), s_(bed.s) {
    for (int d = 0; d < dim(); ++d)
      s_.each(s_.grid.inner_faces(d), [&](int i, int j, int k, std::ptrdiff_t c) {
        if (bed.inertia.f_s[d][c] >= least_solid_fraction) unknown_[d][{i, j, k}] = count_++;
      });
    a_ = Eigen::MatrixXd::Zero(count_, count_);
    b_ = Eigen::VectorXd::Zero(count_);
  }
  int dim() const { return s_.grid.dim; }
  // Adds `factor` times the velocity d at (i, j, k), whatever it is there: unknown, known, wrapped, mirrored.
  void add(Eigen::VectorXd& row, double& constant, double factor, int d, std::array<int, 3> at) const {
    const auto& n = s_.grid.cells.n;
    for (int e = 0; e < dim(); ++e) {
      if (s_.grid.cells.periodic[e]) {
        at[e] = (at[e] + n[e]) % n[e];
      } else if (e == d) {
        if (at[e] <= 0 || at[e] >= n[e]) return;  // on a closed side
      } else if (at[e] < 0 || at[e] >= n[e]) {    // beyond a wall: minus the inside about the wall's velocity
        constant += factor * 2.0 * s_.scene.sides[2 * e + (at[e] < 0 ? 0 : 1)].velocity[d];
        factor = -factor;
        at[e] = at[e] < 0 ? 0 : n[e] - 1;
      }
    }
    const auto found = unknown_[d].find(at);
    if (found != unknown_[d].end()) {
      row[found->second] += factor;
    } else {
      constant += factor * bed_.u[d][s_.grid.cells.index(at)];
    }
  }
  void add_square(double weight, const Eigen::VectorXd& row, double constant) {
    a_ += weight * row * row.transpose();
    b_ -= weight * constant * row;
  }
  template <typename Edge>
  void assemble(const Field& mu, const Field& lambda, Edge&& edge_viscosity) {
    s_.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
      Eigen::VectorXd divergence = Eigen::VectorXd::Zero(count_);
      double known = 0.0;
      for (int d = 0; d < dim(); ++d) {
        Eigen::VectorXd stretch = Eigen::VectorXd::Zero(count_);
        double constant = 0.0;
        std::array<int, 3> ahead{i, j, k};
        ++ahead[d];
        add(stretch, constant, 1.0 / s_.grid.h[d], d, ahead);
        add(stretch, constant, -1.0 / s_.grid.h[d], d, {i, j, k});
        add_square(2.0 * mu[c], stretch, constant);
        divergence += stretch;
        known += constant;
      }
      add_square(lambda[c], divergence, known);
    });
    for (int d = 0; d < dim(); ++d)
      for (int e = d + 1; e < dim(); ++e)
        s_.each(s_.grid.edges(d, e), [&](int i, int j, int k, std::ptrdiff_t c) {
          const auto& l = s_.grid.cells;
          double volume = 1.0;  // share of a cell's: half on a wall; periodic ends are one edge
          for (int g : {d, e}) {
            const int at = g == 0 ? i : (g == 1 ? j : k);
            if (at == l.n[g] && l.periodic[g]) return;
            if (!l.periodic[g] && (at == 0 || at == l.n[g])) volume *= 0.5;
          }
          Eigen::VectorXd shear = Eigen::VectorXd::Zero(count_);
          double constant = 0.0;
          std::array<int, 3> below_e{i, j, k}, below_d{i, j, k};
          --below_e[e];
          --below_d[d];
          add(shear, constant, 1.0 / s_.grid.h[e], d, {i, j, k});
          add(shear, constant, -1.0 / s_.grid.h[e], d, below_e);
          add(shear, constant, 1.0 / s_.grid.h[d], e, {i, j, k});
          add(shear, constant, -1.0 / s_.grid.h[d], e, below_d);
          add_square(volume * edge_viscosity(d, e, c), shear, constant);
        });
  }
  void expect_solution(double tolerance) {
    for (int d = 0; d < dim(); ++d)
      for (const auto& [at, row] : unknown_[d]) {
        const std::ptrdiff_t c = s_.grid.cells.index(at);
        a_(row, row) += bed_.mass[d][c];
        b_[row] += bed_.rhs[d][c];
      }
    const Eigen::VectorXd exact = a_.ldlt().solve(b_);
    ASSERT_GT(exact.lpNorm<Eigen::Infinity>(), 0.1);
    for (int d = 0; d < dim(); ++d)
      for (const auto& [at, row] : unknown_[d])
        EXPECT_NEAR(bed_.u[d][s_.grid.cells.index(at)], exact[row], tolerance) << d;
  }

 private:
  const Bed& bed_;
  const Tank& s_;
  std::array<std::map<std::array<int, 3>, int>, 3> unknown_;
  int count_ = 0;
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
};

// Masses and forces that move the grains at about 1 m/s.
void load_randomly(Bed& bed) {
  for (int d = 0; d < bed.s.grid.dim; ++d)
    bed.s.each(bed.s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      bed.mass[d][c] = bed.s.uniform(0.5, 2.0) * 1250.0 / step;
      bed.rhs[d][c] = bed.s.uniform(-2.0, 2.0) * 1250.0 / step;
    });
}

double mean_around(const Tank& s, const Field& f, int d, int e, std::ptrdiff_t c) {
  const std::ptrdiff_t a = s.grid.stride(d), b = s.grid.stride(e);
  return 0.25 * (f[c] + f[c - a] + f[c - b] + f[c - a - b]);
}

class FrictionAgainstDense : public ::testing::TestWithParam<std::pair<int, bool>> {
 protected:
  Scene scene() const {
    const auto& [dim, periodic] = GetParam();
    Scene scene = box_scene(dim, {6, 5, dim == 3 ? 3 : 1}, {0.6, 0.4, 0.3}, WallKind::no_slip);
    if (periodic) make_periodic(scene, 0);
    scene.sides[top].velocity = {0.8, 0.0, dim == 3 ? -0.3 : 0.0};
    return scene;
  }
};

// Kinetic viscosity with a contrast of 1e6.
TEST_P(FrictionAgainstDense, KineticViscosity) {
  Scene given = scene();
  given.model.contact_friction = false;
  Bed bed(given);
  bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    bed.rheology.kinetic_viscosity[c] = std::pow(10.0, bed.s.uniform(-2.0, 4.0));
  });
  load_randomly(bed);
  bed.solve();
  Energy energy(bed);
  const Field& mu = bed.rheology.kinetic_viscosity;
  energy.assemble(mu, mu, [&](int d, int e, std::ptrdiff_t c) { return mean_around(bed.s, mu, d, e, c); });
  energy.expect_solution(2e-6);
}

// Contact friction of a bed at rest, mu = P eta n / 2, with cells without contact and a corner without
// grains.
TEST_P(FrictionAgainstDense, ContactFrictionBesideEmptyCells) {
  Scene given = scene();
  given.contact.regularisation = 100.0;
  given.sides[top].velocity = {};  // a wall that moves past resting grains would shear them
  Bed bed(given);
  const auto n = bed.s.grid.cells.n;
  bed.s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
    bed.rheology.enduring_pressure[c] = (i + j) % 3 == 0 ? 0.0 : std::pow(10.0, bed.s.uniform(0.0, 3.0));
    if (i >= n[0] - 3 && j >= n[1] - 2) bed.f_s[c] = bed.rheology.enduring_pressure[c] = 0.0;
  });
  load_randomly(bed);
  bed.fill();
  for (int d = 0; d < bed.s.grid.dim; ++d) {  // faces without grains carry a known velocity
    bed.s.each(bed.s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
      if (bed.inertia.f_s[d][c] < least_solid_fraction) bed.u[d][c] = bed.s.uniform(-1.0, 1.0);
    });
    bed.s.boundary.exchange(bed.u[d]);
  }
  bed.solve();
  const double factor = 0.5 * given.solid.friction * given.contact.regularisation;
  const Field& p = bed.rheology.enduring_pressure;
  Field mu(bed.s.grid);
  bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) { mu[c] = factor * p[c]; });
  Energy energy(bed);
  energy.assemble(mu, Field(bed.s.grid), [&](int d, int e, std::ptrdiff_t c) {
    const std::ptrdiff_t a = bed.s.grid.stride(d), b = bed.s.grid.stride(e);
    for (const auto& [direction, face] : {std::pair{d, c}, {d, c - b}, {e, c}, {e, c - a}})
      if (bed.inertia.f_s[direction][face] < least_solid_fraction) return 0.0;
    int contacts = 0;
    for (std::ptrdiff_t cell : {c, c - a, c - b, c - a - b}) contacts += p[cell] > 0.0 ? 1 : 0;
    return contacts > 0 ? factor * mean_around(bed.s, p, d, e, c) * 4.0 / contacts : 0.0;
  });
  energy.expect_solution(2e-6);
}

INSTANTIATE_TEST_SUITE_P(Boxes, FrictionAgainstDense,
                         ::testing::Values(std::pair{2, false}, std::pair{2, true}, std::pair{3, false},
                                           std::pair{3, true}));

TEST(Friction, RigidTranslationInASlipBoxIsNotResisted) {
  Layer layer(Layer::between(WallKind::slip, WallKind::slip));
  layer.rheology.enduring_pressure.fill(1e4);
  layer.rheology.kinetic_viscosity.fill(10.0);
  const double mass = 1250.0 / step;
  layer.set(mass, 0.7 * mass);
  layer.solve();
  layer.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    EXPECT_NEAR(layer.u[0][c], 0.7, 1e-6);
    EXPECT_NEAR(layer.u[1][c], 0.0, 1e-6);
  });
}

TEST(Friction, SteadyShearBetweenMovingWallsIsLinear) {
  Scene scene = Layer::between(WallKind::no_slip, WallKind::no_slip);
  scene.sides[bottom].velocity[0] = -0.5;
  scene.sides[top].velocity[0] = 1.5;
  Layer layer(scene);
  layer.rheology.kinetic_viscosity.fill(3.0);
  layer.set(1e-9, 0.0);
  layer.solve();
  layer.s.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
    EXPECT_NEAR(layer.u[0][c], -0.5 + 2.0 * layer.s.face(0, i, j, k)[1] / 0.16, 1e-6);
  });
}

// Momentum that the layer loses to its walls per area and time [Pa].
double wall_stress(const Layer& layer, double mass, double driven) {
  double lost = 0.0;
  layer.s.each_cell([&](int, int, int, std::ptrdiff_t c) { lost += driven - mass * layer.u[0][c]; });
  return lost * layer.s.grid.h[1] / layer.s.grid.cells.n[0];
}

class CoulombWall : public ::testing::TestWithParam<int> {};

TEST_P(CoulombWall, TakesItsShareOfThePressureAtMost) {
  const bool lower = GetParam() == bottom;
  Scene scene = lower ? Layer::between(WallKind::coulomb, WallKind::slip)
                      : Layer::between(WallKind::slip, WallKind::coulomb);
  scene.sides[GetParam()].solid.friction = 0.3;
  scene.sides[GetParam()].velocity[0] = 0.1;
  const double pressure = 500.0, mass = 1250.0 / step;
  for (double speed : {0.6, -0.4}) {  // sliding either way, relative to a wall that moves at 0.1
    Layer layer(scene);
    layer.rheology.enduring_pressure.fill(pressure);
    layer.u[0].fill(speed);
    for (int i = 0; i < 10; ++i) {  // the wall's viscosity is that of the last velocity
      layer.u_strain = layer.u;
      layer.set(mass, mass * speed);
      layer.solve();
    }
    EXPECT_NEAR(wall_stress(layer, mass, mass * speed), std::copysign(0.3 * pressure, speed - 0.1),
                1e-3 * 0.3 * pressure);
  }
  // so slow that the wall can hold it: it stops at the wall's speed
  Layer layer(scene);
  layer.rheology.enduring_pressure.fill(pressure);
  const double slow = 0.1 + 0.5 * 0.3 * pressure / (mass * 0.16);
  layer.u[0].fill(slow);
  for (int i = 0; i < 200; ++i) {
    layer.u_strain = layer.u;
    layer.set(mass, mass * slow);
    layer.solve();
  }
  layer.s.each_cell([&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(layer.u[0][c], 0.1, 1e-6); });
}

INSTANTIATE_TEST_SUITE_P(BelowAndAbove, CoulombWall, ::testing::Values(bottom, top),
                         [](const auto& instance) { return instance.param == bottom ? "bottom" : "top"; });

// Uniform shear of rate G: each volume loses tau G, tau of the law at |S| = G / 2 (deviator's norm),
// dilatancy on top of the coefficient of friction.
TEST(Friction, UniformShearTakesTheLawsPower) {
  Scene scene = Layer::between(WallKind::no_slip, WallKind::no_slip);
  scene.sides[top].velocity[0] = 2.0;
  scene.contact.regularisation = 0.05;  // far from both ends of the law
  const double rate = 2.0 / 0.16, pressure = 300.0, tan_psi = 0.15;
  Layer layer(scene);
  layer.rheology.enduring_pressure.fill(pressure);
  layer.rheology.dilatancy_tangent.fill(tan_psi);
  layer.s.each_cell(
      [&](int i, int j, int k, std::ptrdiff_t c) { layer.u[0][c] = rate * layer.s.face(0, i, j, k)[1]; });
  layer.u_strain = layer.u;
  layer.set(1e-9, 0.0);
  layer.solve();
  Field kinetic(layer.s.grid);
  const double stress =
      closures::friction_viscosity(pressure, scene.solid.friction + tan_psi, 0.05, 0.5 * rate) * rate;
  EXPECT_NEAR(layer.power(layer.u, layer.u, kinetic).friction, stress * rate * 0.04 * 0.16,
              1e-4 * stress * rate * 0.04 * 0.16);
}

// Stretch without shear: a cell loses 2 mu (du/dx)^2, mu of the law (17) at ||S|| = sqrt(S:S / 2), S:S =
// (du/dx)^2.
TEST(Friction, StretchTakesTheLawsPower) {
  Scene scene = box_scene(2, {8, 4, 1}, {0.08, 0.04, 1.0}, WallKind::slip);
  scene.contact.regularisation = 0.05;         // far from both ends of the law
  const double pressure = 300.0, heavy = 1e9;  // so heavy that nothing moves
  Bed bed(scene);
  bed.rheology.enduring_pressure.fill(pressure);
  bed.u = bed.s.faces({[](const Vec3& x) { return 0.2 * std::sin(M_PI * x[0] / 0.08); },
                       [](const Vec3&) { return 0.0; }, [](const Vec3&) { return 0.0; }});
  bed.u_strain = bed.u;
  for (int d : {0, 1}) {
    bed.mass[d].fill(heavy);
    bed.s.each(bed.s.grid.inner_faces(d),
               [&](int, int, int, std::ptrdiff_t c) { bed.rhs[d][c] = heavy * bed.u[d][c]; });
  }
  bed.solve();
  double expected = 0.0;
  bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    const double stretch = std::fabs(bed.u[0][c + 1] - bed.u[0][c]) / bed.s.grid.h[0];
    expected += bed.s.grid.cell_volume * 2.0 * stretch * stretch *
                closures::friction_viscosity(pressure, scene.solid.friction, 0.05, stretch / std::sqrt(2.0));
  });
  Field kinetic(bed.s.grid);
  EXPECT_NEAR(bed.power(bed.u, bed.u, kinetic).friction, expected, 1e-6 * expected);
}

// In 3D the wall's stress opposes the sliding, at mu_w P_s in all and not in each direction.
TEST(Friction, CoulombWallLimitsTheVectorOfItsStress) {
  Scene scene = box_scene(3, {4, 8, 4}, {0.04, 0.08, 0.04}, WallKind::slip);
  make_periodic(scene, 0);
  make_periodic(scene, 2);
  scene.sides[bottom].solid = {WallKind::coulomb, 0.3};
  scene.sides[bottom].velocity = {0.1, 0.0, -0.2};
  const double pressure = 500.0, mass = 1250.0 / step;
  const Vec3 sliding{0.6, 0.0, -0.8};  // relative to the wall; its length is 1
  Bed bed(scene);
  bed.rheology.enduring_pressure.fill(pressure);
  for (const int d : {0, 1, 2}) bed.mass[d].fill(mass);
  Vec3 start{};
  for (const int d : {0, 2}) {
    start[d] = sliding[d] + scene.sides[bottom].velocity[d];
    bed.u[d].fill(start[d]);
    bed.s.each(bed.s.grid.inner_faces(d),
               [&](int, int, int, std::ptrdiff_t c) { bed.rhs[d][c] = mass * start[d]; });
  }
  for (int i = 0; i < 10; ++i) {  // the wall's viscosity is that of the last velocity
    bed.u_strain = bed.u;
    bed.solve();
  }
  for (const int d : {0, 2}) {
    double lost = 0.0;
    bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) { lost += mass * (start[d] - bed.u[d][c]) / 16.0; });
    EXPECT_NEAR(lost * bed.s.grid.h[1], 0.3 * pressure * sliding[d], 2e-3 * 0.3 * pressure) << d;
  }
}

TEST(Friction, SlipWallsTakeNoTangentialForceAndNoSlipWallsDo) {
  const double mass = 1250.0 / step;
  for (WallKind kind : {WallKind::slip, WallKind::no_slip}) {
    Layer layer(Layer::between(kind, WallKind::slip));
    layer.rheology.kinetic_viscosity.fill(50.0);
    layer.rheology.enduring_pressure.fill(1000.0);
    // a sheared guess and a sheared force: stresses inside are large, their sum must vanish on slip walls
    layer.set(mass, 0.0);
    double driven = 0.0;
    layer.s.each_cell([&](int, int j, int, std::ptrdiff_t c) {
      layer.rhs[0][c] = mass * (0.5 + 0.1 * j);
      driven += layer.rhs[0][c] / 64.0;
    });
    layer.solve();
    const double stress = wall_stress(layer, mass, driven);
    if (kind == WallKind::slip) {
      EXPECT_NEAR(stress, 0.0, 1e-5 * driven * 0.16);
    } else {
      EXPECT_GT(stress, 0.1 * driven * 0.16);
    }
  }
}

}  // namespace
}  // namespace granvof
