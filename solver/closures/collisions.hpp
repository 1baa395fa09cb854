// What a scene chose of the laws of collisions: g0, how collisions of dense grains are correlated, and what
// flying grains carry.
// Equations: docs/theory/contact.md, docs/theory/kinetic-theory.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::closures {

// Correlation length of collisions over d_s [-], L = max(1, 1/2 (30 (1 - e) f_s^2 g0 / (1 + pi / 12))^(1/3)):
// in dense flow the grains that collide have collided before and are slower than chance would have them; they
// dissipate 1 / L of (23) (Jenkins, Granul. Matter 10 (2007) 47). f_s >= 0, e in [0, 1], g0 of f_s. Limits: 1
// for dilute or elastic grains. Steady shear has d_s^2 gamma^2 = 15 (1 - e) Theta / L then, so that (15) is
// divided by L too.
inline double correlation_length(double f_s, double e, double g0) {
  constexpr double factor = 30.0 / (1.0 + std::numbers::pi / 12.0);
  return std::max(1.0, 0.5 * std::cbrt(factor * (1.0 - e) * f_s * f_s * g0));
}

// The laws of a scene as one object. Grains rub by solid.friction in g0, as in frictional_restitution().
struct Collisions {
  RadialDistribution radial;
  KineticTransport transport;
  bool correlated = false;
  RadialParameters of_g0{Contact{}.solid_fraction_max, jamming_amplitude(0.0)};

  Collisions() = default;
  explicit Collisions(const Contact& contact) : of_g0{contact.solid_fraction_max, jamming_amplitude(0.0)} {}
  explicit Collisions(const Scene& scene)
      : radial(scene.model.radial_distribution),
        transport(scene.model.kinetic_transport),
        correlated(scene.model.correlated_collisions),
        of_g0{scene.contact.solid_fraction_max, jamming_amplitude(scene.solid.friction)} {}

  double g0(double f_s) const {
    return radial.with([&](auto law) { return law.value(f_s, of_g0); });
  }
  double g0_slope(double f_s) const {
    return radial.with([&](auto law) { return law.slope(f_s, of_g0); });
  }
  double correlation(double f_s, double e) const {
    return correlated ? correlation_length(f_s, e, g0(f_s)) : 1.0;
  }
  // d ln L / d f_s [-]
  double correlation_log_slope(double f_s, double e) const {
    if (correlation(f_s, e) <= 1.0) return 0.0;
    return (2.0 / f_s + g0_slope(f_s) / g0(f_s)) / 3.0;
  }
  // f_s mu_s^K [Pa s] of (16); f_s > 0, SI units.
  double viscosity(double f_s, double theta, double e, double rho_s, double d_s) const {
    const double g = g0(f_s);
    const double factor = transport.with([&](auto law) { return law.viscosity(f_s, e, g); });
    return factor * f_s * kinetic_viscosity(f_s, theta, e, g, rho_s, d_s);
  }
  // gamma_s^K / Theta^(3/2) [kg/m4]; f_s > 0, SI units.
  double dissipation_rate(double f_s, double e, double rho_s, double d_s) const {
    return collisional_dissipation_rate(f_s, e, g0(f_s), rho_s, d_s) / correlation(f_s, e);
  }
  // P_s^K / Theta [kg/m3]
  double pressure(double f_s, double e, double rho_s) const {
    return kinetic_pressure(f_s, 1.0, e, g0(f_s), rho_s);
  }
  double conductivity_to_viscosity(double f_s, double e) const {
    return transport.with([&](auto law) { return law.conductivity(f_s, e, g0(f_s)); });
  }
};

}  // namespace granvof::closures
