// Units of every closure: in other units of mass, length and time its value changes by its dimension alone.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/contact_friction.hpp"
#include "solver/closures/drag/drag.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/restitution.hpp"
#include "solver/closures/smagorinsky.hpp"
#include "solver/closures/solid_pressure.hpp"

namespace granvof::closures {
namespace {

// How many new units one SI unit is.
struct Units {
  double kg;
  double m;
  double s;

  double density() const { return kg / (m * m * m); }
  double viscosity() const { return kg / (m * s); }
  double pressure() const { return kg / (m * s * s); }
  double speed() const { return m / s; }
  double theta() const { return speed() * speed(); }
};

constexpr Units si{1.0, 1.0, 1.0};
constexpr Units other{3.0, 7.0, 0.2};

struct Values {
  double drag, restitution, eddy, pressure, enduring, viscosity, dissipation, expansion, friction, inertial;
};

Values evaluate(const Units& u) {
  Contact contact;
  contact.stiffness *= u.pressure();
  contact.regularisation *= u.s;
  const Fluid gas{.density = 1.0 * u.density(), .viscosity = 1e-5 * u.viscosity()};
  const Fluid liquid{.density = 1000.0 * u.density(), .viscosity = 1e-3 * u.viscosity()};
  const double rho_s = 2500.0 * u.density();
  const double d_s = 8e-4 * u.m;
  const double theta = 0.04 * u.theta();
  const double e = effective_restitution(0.9, theta, rho_s, d_s, liquid.viscosity);
  const double f_s = 0.58;
  const double g0 = RadialPaper::value(f_s, {contact.solid_fraction_max});
  const double enduring = enduring_pressure(f_s, theta, e, rho_s, contact, true);
  return {.drag = drag_coefficient(drag_paper, 0.2, 0.6, 0.3 * u.speed(), gas, liquid, d_s),
          .restitution = e,
          .eddy = eddy_viscosity(liquid.density, 2e-3 * u.m, 50.0 / (u.s * u.s)),
          .pressure = solid_pressure(f_s, theta, e, rho_s, contact, true).value,
          .enduring = enduring,
          .viscosity = kinetic_viscosity(f_s, theta, e, g0, rho_s, d_s),
          .dissipation = collisional_dissipation_rate(f_s, e, g0, rho_s, d_s) * theta * std::sqrt(theta),
          .expansion = expansion_dissipation_rate(f_s, e, g0, rho_s, -3.0 / u.s) * theta,
          .friction = friction_viscosity(enduring, 0.4, contact.regularisation, 2e-5 / u.s),
          .inertial = FrictionInertial::coefficient({enduring, 10.0 / u.s}, {rho_s, d_s, 0.9, 0.4}, contact)};
}

TEST(Units, EveryClosureIsDimensionallyConsistent) {
  const Values a = evaluate(si);
  const Values b = evaluate(other);
  const auto expect_scaled = [](double in_si, double in_other, double factor, const char* name) {
    EXPECT_GT(in_si, 0.0) << name;
    EXPECT_NEAR(in_other / in_si, factor, 1e-12 * factor) << name;
  };
  expect_scaled(a.drag, b.drag, other.density() / other.s, "drag coefficient [kg/m3 s]");
  expect_scaled(a.restitution, b.restitution, 1.0, "restitution [-]");
  expect_scaled(a.eddy, b.eddy, other.viscosity(), "eddy viscosity [Pa s]");
  expect_scaled(a.pressure, b.pressure, other.pressure(), "solid pressure [Pa]");
  expect_scaled(a.enduring, b.enduring, other.pressure(), "enduring pressure [Pa]");
  expect_scaled(a.viscosity, b.viscosity, other.viscosity(), "kinetic viscosity [Pa s]");
  expect_scaled(a.dissipation, b.dissipation, other.pressure() / other.s, "dissipation [W/m3]");
  expect_scaled(a.expansion, b.expansion, other.pressure() / other.s, "dissipation of an expansion [W/m3]");
  expect_scaled(a.friction, b.friction, other.viscosity(), "friction viscosity [Pa s]");
  expect_scaled(a.inertial, b.inertial, 1.0, "inertial friction [-]");
}

}  // namespace
}  // namespace granvof::closures
