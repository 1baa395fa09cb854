// Where (15) comes from: the dense-flow law and the balance of steady simple shear.
//
// The flow law ties the packing to the inertial number, 1/f_s = 1/f_s0 + a' I^delta with I = 2 d_s ||S|| /
// sqrt(P / rho_s); the balance ties ||S|| to Theta: production of fluctuating energy by the kinetic stress
// equals its dissipation in collisions. Neither uses (15), which must come out, with its factor.
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/radial_distribution/laws.hpp"

namespace granvof::closures {
namespace {

const Contact paper;
constexpr double rho_s = 2500.0;  // [kg/m3]
constexpr double d_s = 0.8e-3;    // [m]

struct State {
  double f_s;
  double theta;  // [m2/s2]
  double e;
};

// ||S|| [1/s] of a steady simple shear of rate G = 2 ||S||, found by bisection. The work of the stress is
// tau:S with tau = 2 f mu S, S_xy = S_yx = G/2; `printed_factor` is the 2 that (7) prints in front of it,
// or 1.
double steady_strain(const State& s, double printed_factor) {
  const double g0 = RadialPaper::value(s.f_s, {paper.solid_fraction_max});
  const double mu = kinetic_viscosity(s.f_s, s.theta, s.e, g0, rho_s, d_s);
  const double lost = collisional_dissipation_rate(s.f_s, s.e, g0, rho_s, d_s) * std::pow(s.theta, 1.5);
  const auto production = [&](double norm) {
    const double s_xy = norm;  // G/2
    return printed_factor * 2.0 * s.f_s * mu * (s_xy * s_xy + s_xy * s_xy);
  };
  double low = 0.0;
  double high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (production(middle) < lost ? low : high) = middle;
  }
  return low;
}

// P [Pa] at which the flow law gives the packing f_s at the strain ||S||.
double pressure_of_flow_law(double f_s, double strain) {
  const double inertial_number = std::pow(
      (1.0 / f_s - 1.0 / paper.dense_solid_fraction) / paper.flow_law_factor, 1.0 / paper.flow_law_exponent);
  const double root = 2.0 * d_s * strain / inertial_number;
  return rho_s * root * root;
}

// (15) without its leading number: rho_s Theta (1 - e) (a' f f0 / (f0 - f))^(2/delta).
double bracket(const State& s) {
  const double f0 = paper.dense_solid_fraction;
  return rho_s * s.theta * (1.0 - s.e) *
         std::pow(paper.flow_law_factor * s.f_s * f0 / (f0 - s.f_s), 2.0 / paper.flow_law_exponent);
}

const State states[] = {{0.45, 1e-4, 0.8}, {0.55, 1e-2, 0.3}, {0.59, 1e-6, 0.0}, {0.57, 1.0, 0.95}};

TEST(DenseFlowLaw, SteadyShearTiesStrainToTheta) {
  for (const State& s : states) {
    const double strain = steady_strain(s, 1.0);
    EXPECT_NEAR(d_s * d_s * strain * strain / ((1.0 - s.e) * s.theta), 15.0 / 4.0, 1e-9);
  }
}

TEST(DenseFlowLaw, GivesTheDensePressure) {
  for (const State& s : states) {
    const double derived = pressure_of_flow_law(s.f_s, steady_strain(s, 1.0));
    EXPECT_NEAR(dense_pressure(s.f_s, s.theta, s.e, rho_s, paper).value, derived, 1e-8 * derived) << s.f_s;
  }
}

TEST(DenseFlowLaw, FactorOfTheDensePressureBySource) {
  const State s = states[0];
  const double g0 = RadialPaper::value(s.f_s, {paper.solid_fraction_max});
  const double mu = kinetic_viscosity(s.f_s, s.theta, s.e, g0, rho_s, d_s);
  const double zeta = bulk_to_shear_viscosity * kinetic_viscosity(s.f_s, s.theta, s.e, g0, rho_s, d_s);

  const double derived = pressure_of_flow_law(s.f_s, steady_strain(s, 1.0)) / bracket(s);
  const double derived_with_printed_work = pressure_of_flow_law(s.f_s, steady_strain(s, 2.0)) / bracket(s);
  const double lambda_is_bulk = 9.0 * zeta / mu;
  const double lambda_is_lame = 9.0 * (zeta - 2.0 / 3.0 * mu) / mu;
  const double in_code = dense_pressure(s.f_s, s.theta, s.e, rho_s, paper).value / bracket(s);

  std::cout << "factor of rho_s Theta (1 - e) (...)^(2/delta) in (15)\n"
            << "  derived, work of the stress tau:S           " << derived << '\n'
            << "  derived, work as printed in (7), 2 tau:S    " << derived_with_printed_work << '\n'
            << "  printed, lambda = bulk viscosity zeta       " << lambda_is_bulk << '\n'
            << "  printed, lambda = zeta - 2/3 mu             " << lambda_is_lame << '\n'
            << "  in use                                      " << in_code << '\n';

  EXPECT_NEAR(derived, 15.0, 1e-7);
  EXPECT_NEAR(derived_with_printed_work, 7.5, 1e-7);
  EXPECT_NEAR(lambda_is_bulk, 15.0, 1e-12);
  EXPECT_NEAR(lambda_is_lame, 9.0, 1e-12);
  EXPECT_NEAR(in_code, derived, 1e-7);
}

}  // namespace
}  // namespace granvof::closures
