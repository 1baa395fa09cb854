// Granular temperature: cooling, the steady balance of simple shear, and states it must survive.
#include <gtest/gtest.h>

#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/operators/granular_temperature.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::make_periodic;
using test::Tank;
using test::unit_scene;

// What the kinetic stress (16) of the grains dissipates under a strain [W/m3], Theta predicted as in a step.
Field production_of(const Tank& s, double dt, const State& now, const Field& beta, const StrainRate& strain,
                    const GranularTemperature& temperature, Rheology& rheology) {
  Field stirred(s.grid), production(s.grid);
  temperature.predict(dt, now, beta, rheology.restitution, strain, stirred);
  rheology.update_kinetic_viscosity(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, now.f_s,
                                    stirred);
  for_each(s.grid.cells, [&](std::ptrdiff_t c) {
    const double div = strain.divergence[c];
    production[c] = rheology.kinetic_viscosity[c] * (2.0 * strain.squared[c] + div * div);
  });
  return production;
}

// Grains at uniform f_s under a uniform velocity gradient, restitution e0 (fluids without viscosity).
struct Gas {
  explicit Gas(const Scene& given, double f_s_value, double theta_value)
      : s(given),
        now(s.uniform_state(f_s_value)),
        next(now),
        beta(s.grid),
        flux(s.grid),
        rheology(s.grid),
        strain(s.grid),
        laws(s.scene),
        temperature(s.grid, s.scene, s.boundary, laws) {
    theta.fill(theta_value);
  }
  static Scene scene(double e0) {
    Scene scene = unit_scene(2, 4);
    for (int d : {0, 1}) make_periodic(scene, d);
    scene.solid = {2500.0, 1e-3, e0, 0.4};
    scene.gas.viscosity = scene.liquid.viscosity = 0.0;
    return scene;
  }
  void deform(double shear, double stretch) {
    strain.update(s.grid, s.boundary.walls(),
                  s.faces({[=](const Vec3& x) { return stretch * x[0] + shear * x[1]; },
                           [=](const Vec3& x) { return stretch * x[1]; }, [](const Vec3&) { return 0.0; }}));
  }
  // f_s stays as it is: what the local balance does to Theta alone.
  void advance(double dt) {
    rheology.update(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, now, strain);
    const Field production = production_of(s, dt, now, beta, strain, temperature, rheology);
    temperature.advance(dt, now, flux, beta, rheology, strain, production, next);
    std::swap(theta, next.theta);
    s.boundary.fill_scalar(theta);
  }
  double value() const {
    EXPECT_NEAR(s.smallest(theta), s.largest(theta), 1e-6 * s.largest(theta));
    return theta[s.grid.cells.index(1, 1, 0)];
  }
  Tank s;
  State now, next;
  Field& theta = now.theta;
  Field beta;
  FaceField flux;
  Rheology rheology;
  StrainRate strain;
  closures::Collisions laws;
  GranularTemperature temperature;
};

// Haff's law, from (23): Theta = Theta0 / (1 + t / tau)^2, 1 / tau = 4 (1 - e^2) f g0 sqrt(Theta0) / (d
// sqrt(pi)).
TEST(GranularTemperature, CoolsByHaffsLaw) {
  const double f = 0.3, e = 0.8, theta0 = 0.01, d = 1e-3;
  const double g0 = (1.0 - 7.0 / 16.0 * f) / std::pow(1.0 - f / 0.63, 2);
  const double tau = d * std::sqrt(M_PI) / (4.0 * (1.0 - e * e) * f * g0 * std::sqrt(theta0));
  const auto error = [&](int steps) {
    Gas gas(Gas::scene(e), f, theta0);
    for (int i = 0; i < steps; ++i) gas.advance(5.0 * tau / steps);
    return gas.value() / (theta0 / 36.0) - 1.0;  // after 5 tau
  };
  const double coarse = error(50), fine = error(100);
  RecordProperty("error_at_tau_10", std::to_string(coarse));
  EXPECT_LT(std::fabs(fine), 0.06);
  EXPECT_NEAR(coarse / fine, 2.0, 0.15);  // first order in time
}

// Production against collisions in simple shear of rate G: Theta = d^2 G^2 / (15 (1 - e)), see the
// corrections of (15).
TEST(GranularTemperature, SteadySimpleShear) {
  const double e = 0.9, d = 1e-3, shear = 20.0;
  const double steady = d * d * shear * shear / (15.0 * (1.0 - e));
  for (double f : {0.1, 0.55}) {
    Scene scene = Gas::scene(e);
    scene.model.granular_temperature = TemperatureModel::of<closures::TemperatureAlgebraic>();
    Gas algebraic(scene, f, 0.0);
    algebraic.deform(shear, 0.0);
    algebraic.advance(1e-3);
    EXPECT_NEAR(algebraic.value(), steady, 1e-9 * steady);

    Gas transported(Gas::scene(e), f, 0.0);  // from nothing, no seed
    transported.deform(shear, 0.0);
    double last = 0.0;
    for (int i = 0; i < 400; ++i) {
      transported.advance(0.05);
      EXPECT_GE(transported.value(), last * (1.0 - 1e-6));  // up to its limit
      last = transported.value();
    }
    EXPECT_NEAR(last, steady, 1e-5 * steady);
  }
}

// Gravity and moving walls give a grain a fall through the tank and the speed of a wall at most: 3/2 Theta =
// g H + 1/2 v^2. Shear that would make more, and a start that has more, end there.
TEST(GranularTemperature, IsBoundedByAFallThroughTheTank) {
  const double wall = 3.0, most = 2.0 / 3.0 * (9.81 + 0.5 * wall * wall);
  Scene scene = Gas::scene(0.9);
  for (Side& side : scene.sides) side.kind = SideKind::wall;
  scene.gravity = 9.81;
  scene.sides[top].velocity = {wall, 0.0, 0.0};
  Gas hot(scene, 0.3, 100.0);
  hot.advance(1e-6);
  EXPECT_NEAR(hot.value(), most, 1e-12 * most);
  scene.model.granular_temperature = TemperatureModel::of<closures::TemperatureAlgebraic>();
  Gas sheared(scene, 0.3, 0.0);
  sheared.deform(2e4, 0.0);
  sheared.advance(1e-3);
  EXPECT_NEAR(sheared.value(), most, 1e-12 * most);
}

TEST(GranularTemperature, OffStaysZero) {
  Scene scene = Gas::scene(0.9);
  scene.model.granular_temperature = TemperatureModel::of<closures::TemperatureOff>();
  Gas gas(scene, 0.4, 0.0);
  gas.deform(50.0, 0.0);
  gas.advance(0.01);
  EXPECT_EQ(gas.value(), 0.0);
}

// Elastic grains (no collisional loss, and so small that viscous heating vanishes) under compression:
// d(sqrt Theta)/dt = -(1 + 4 f g0) / 3 div u sqrt(Theta). No step, however large, may overshoot that
// exponential (a growth term taken implicitly has a pole) or fall below what it started from.
TEST(GranularTemperature, CompressionHeatsNoMoreThanItsWork) {
  const double theta0 = 1e-4, dt = 1e-3;
  for (double f : {2e-3, 0.05, 0.3, 0.55})
    for (double strain : {0.01, 0.5, 1.0, 2.0, 2.9, 3.0, 3.1, 10.0}) {  // -div u dt
      Scene scene = Gas::scene(1.0);
      scene.solid.diameter = 1e-12;
      Gas gas(scene, f, theta0);
      gas.deform(0.0, -0.5 * strain / dt);
      gas.advance(dt);
      const double growth = strain * (1.0 + 4.0 * f * closures::RadialPaper::value(f, {0.63})) / 3.0;
      EXPECT_GT(gas.value(), theta0 * (1.0 + 1.9 * growth)) << f << ' ' << strain;
      EXPECT_LT(gas.value(), theta0 * std::exp(2.0 * growth) * (1.0 + 1e-6)) << f << ' ' << strain;
    }
}

TEST(GranularTemperature, PressureWorkIsASwitch) {
  Scene scene = Gas::scene(0.9);
  scene.model.pressure_work = false;
  Gas without(scene, 0.3, 1e-4), with(Gas::scene(0.9), 0.3, 1e-4);
  for (Gas* gas : {&without, &with}) {
    gas->deform(0.0, -5.0);
    gas->advance(1e-2);
  }
  EXPECT_GT(with.value(), 1.05 * without.value());
}

TEST(GranularTemperature, ExpansionCoolsToZeroAtMost) {
  for (double strain : {0.1, 3.0, 100.0}) {
    Gas gas(Gas::scene(0.9), 0.3, 1e-4);
    gas.deform(0.0, 0.5 * strain / 1e-3);
    gas.advance(1e-3);
    EXPECT_GE(gas.value(), 0.0);
    EXPECT_TRUE(std::isfinite(gas.value()));
  }
}

TEST(GranularTemperature, DragDampsIt) {
  Gas gas(Gas::scene(1.0), 0.3, 1e-4);  // elastic: drag alone, d(ln Theta)/dt = -2 beta / (f rho)
  const double beta = 5e4, dt = 1e-5;
  gas.beta.fill(beta);
  for (int i = 0; i < 100; ++i) gas.advance(dt);
  EXPECT_NEAR(gas.value(), 1e-4 * std::exp(-2.0 * beta / (0.3 * 2500.0) * 1e-3), 0.001 * 1e-4);
}

TEST(GranularTemperature, NoneWhereGrainsAreTooFewToCollide) {
  Gas gas(Gas::scene(0.9), 9e-4, 1e-2);
  gas.deform(100.0, -100.0);
  gas.advance(1e-3);
  EXPECT_EQ(gas.value(), 0.0);
}

TEST(GranularTemperature, IsCarriedAndConductedWithoutNewExtremes) {
  Gas gas(Gas::scene(1.0), 0.4, 0.0);  // elastic, no strain: f Theta is conserved
  gas.theta = gas.s.cells([](const Vec3& x) { return x[0] < 0.5 ? 1e-2 : 1e-4; });
  gas.s.boundary.fill_scalar(gas.theta);
  gas.flux[0].fill(0.4 * 0.3);
  const double before = gas.s.total(gas.theta);
  for (int i = 0; i < 20; ++i) {
    gas.advance(0.1);
    EXPECT_GE(gas.s.smallest(gas.theta), 1e-4 * (1.0 - 1e-6));
    EXPECT_LE(gas.s.largest(gas.theta), 1e-2 * (1.0 + 1e-6));
  }
  EXPECT_NEAR(gas.s.total(gas.theta), before, 1e-3 * before);  // the conduction solve's tolerance
  EXPECT_LT(gas.s.largest(gas.theta), 0.9e-2);
}

// In steady compression, by hand: a w^2 + b w = c with w^2 = Theta, a what collisions take, b what div u_s <
// 0 takes of (23) and c what the stress (16) with both its viscosities gives.
TEST(GranularTemperature, PredictionInSteadyCompression) {
  const double f = 0.3, e = 0.9, rho = 2500.0, d = 1e-3, stretch = -20.0, div = 2.0 * stretch;
  Scene scene = Gas::scene(e);
  scene.model.granular_temperature = TemperatureModel::of<closures::TemperatureAlgebraic>();
  scene.model.pressure_work = false;
  Gas gas(scene, f, 0.0);
  gas.rheology.restitution.fill(e);
  gas.strain.squared.fill(2.0 * stretch * stretch);
  Field predicted(gas.s.grid);
  const double g0 = closures::RadialPaper::value(f, {scene.contact.solid_fraction_max}), loss = 1.0 - e * e;
  const double a = 12.0 * loss * f * f * rho * g0 / (d * std::sqrt(M_PI));
  for (const double sign : {1.0, -1.0}) {  // compression takes, expansion gives nothing here
    gas.strain.divergence.fill(sign * div);
    gas.temperature.predict(1e-3, gas.now, gas.beta, gas.rheology.restitution, gas.strain, predicted);
    const double b = std::max(-3.0 * loss * f * f * rho * g0 * sign * div, 0.0);
    const double mu = f * 0.8 * rho * d * f * g0 * (1.0 + e) / std::sqrt(M_PI);
    const double c = mu * (4.0 * stretch * stretch + (5.0 / 3.0 - 2.0 / 3.0) * div * div);
    const double w = (std::sqrt(b * b + 4.0 * a * c) - b) / (2.0 * a);
    EXPECT_NEAR(predicted[gas.s.grid.cells.index(1, 1, 0)], w * w, 1e-9 * w * w) << sign;
  }
}

// A wave of elastic grains decays by kappa / (3/2 f rho), here in one implicit step.
TEST(GranularTemperature, AWaveDecaysByItsConductivity) {
  const double f = 0.4, mean = 1e-2, amplitude = 1e-3, mu = 100.0, dt = 0.1, rho = 2500.0;
  Scene scene = unit_scene(2, 16);
  for (int d : {0, 1}) make_periodic(scene, d);
  scene.solid = {rho, 1e-3, 1.0, 0.4};
  scene.gas.viscosity = scene.liquid.viscosity = 0.0;
  Gas gas(scene, f, 0.0);
  gas.theta = gas.s.cells([&](const Vec3& x) { return mean + amplitude * std::cos(2.0 * M_PI * x[0]); });
  gas.s.boundary.fill_scalar(gas.theta);
  gas.rheology.restitution.fill(1.0);
  gas.rheology.kinetic_viscosity.fill(mu);
  gas.temperature.advance(dt, gas.now, gas.flux, gas.beta, gas.rheology, gas.strain, Field(gas.s.grid),
                          gas.next);
  const double h = gas.s.grid.h[0],
               rate = 2.5 * mu * (2.0 - 2.0 * std::cos(2.0 * M_PI * h)) / (h * h) / (1.5 * f * rho);
  EXPECT_NEAR(gas.s.largest(gas.next.theta) - gas.s.smallest(gas.next.theta),
              (gas.s.largest(gas.theta) - gas.s.smallest(gas.theta)) / (1.0 + dt * rate), 1e-3 * amplitude);
  EXPECT_GT(dt * rate, 0.01);
}

TEST(GranularTemperature, SurvivesRandomStates) {
  for (int dim : {2, 3})
    for (int round = 0; round < 20; ++round) {
      Scene scene = unit_scene(dim, 6);
      scene.sides[top].kind = SideKind::open;
      Tank s(scene);
      State now = s.uniform_state(0.0);
      Field &f = now.f_s, &theta = now.theta;
      f = s.random_cells(-0.2, 0.64);
      theta = s.random_cells(-0.1, 0.3);
      s.each_cell([&](int, int, int, std::ptrdiff_t c) {
        f[c] = std::fmax(f[c], 0.0);
        theta[c] = std::fmax(theta[c], 0.0);
      });
      s.boundary.fill_scalar(f, 0.0);
      s.boundary.fill_scalar(theta);
      Rheology rheology(s.grid);
      rheology.update(s.grid, s.scene, closures::SolidLaw(s.scene), s.boundary, now, StrainRate(s.grid));
      FaceField u = s.random_faces(-30.0, 30.0);
      s.boundary.fill_velocity(u, Phase::solid);
      StrainRate strain(s.grid);
      strain.update(s.grid, s.boundary.walls(), u);
      const closures::Collisions laws(s.scene);
      GranularTemperature temperature(s.grid, s.scene, s.boundary, laws);
      const Field beta = s.random_cells(0.0, 1e5);
      const Field production = production_of(s, 1e-3, now, beta, strain, temperature, rheology);
      State next = now;
      temperature.advance(1e-3, now, FaceField(s.grid), beta, rheology, strain, production, next);
      s.each_cell([&](int, int, int, std::ptrdiff_t c) {
        ASSERT_TRUE(std::isfinite(next.theta[c]));
        ASSERT_GE(next.theta[c], 0.0);
      });
    }
}

}  // namespace
}  // namespace granvof
