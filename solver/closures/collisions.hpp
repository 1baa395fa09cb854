// What a scene chose of the laws of collisions: g0, how collisions of dense grains are correlated, and what
// flying grains carry.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/radial_distribution.hpp"
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

// (mu_s^K with streaming) / (mu_s^K of (20)) [-]. f_s mu_s^K / (rho_s d_s sqrt(Theta)) is
//   4/5 f^2 g0 (1 + e) / sqrt(pi) + sqrt(pi) f^2 g0 (1 + e) (3e - 1) / (15 (3 - e)) + sqrt(pi) f / (6 (3 -
//   e)),
// the first term (20), the others what grains carry as they fly (Syamlal, Rogers and O'Brien, MFIX
// Documentation (1993)). f_s > 0, e in [0, 1]. Kept from falling below (20), which the second term does for e
// < 1/3. Limits: grows as 1 / (f_s g0) for dilute grains, so that f_s mu_s^K does not vanish as f_s^2 but as
// f_s.
inline double streaming_viscosity(double f_s, double e, double g0) {
  constexpr double pi = std::numbers::pi;
  const double own = 5.0 * pi / (4.0 * (1.0 + e) * (3.0 - e));  // over the first term
  return 1.0 + own * std::max((1.0 + e) * (3.0 * e - 1.0) / 15.0 + 1.0 / (6.0 * f_s * g0), 0.0);
}

// kappa_s^K / mu_s^K [-] with streaming in both; f_s kappa_s^K / (rho_s d_s sqrt(Theta)) is
//   2 f^2 g0 (1 + e) / sqrt(pi) + [9/32 (1 + e)^2 (2e - 1) f^2 g0 + 15/32 f] sqrt(pi) / ((49 - 33 e) / 16)
// (Syamlal et al. 1993), kept from falling below (22).
inline double streaming_conductivity_to_viscosity(double f_s, double e, double g0) {
  constexpr double pi = std::numbers::pi;
  const double own = pi / (2.0 * (1.0 + e)) * 16.0 / (49.0 - 33.0 * e);  // over the first term
  const double flown = 9.0 / 32.0 * (1.0 + e) * (1.0 + e) * (2.0 * e - 1.0) + 15.0 / (32.0 * f_s * g0);
  return conductivity_to_viscosity * (1.0 + own * std::max(flown, 0.0)) / streaming_viscosity(f_s, e, g0);
}

// The laws of a scene as one object. Grains rub by solid.friction in g0, as in frictional_restitution().
struct Collisions {
  RadialDistribution radial = RadialDistribution::paper;
  KineticTransport transport = KineticTransport::collisional;
  bool correlated = false;
  double f_max = Contact{}.solid_fraction_max;  // f_s,max of g0 [-]
  double amplitude = jamming_amplitude(0.0);    // of g0 near jamming [-]

  Collisions() = default;
  explicit Collisions(const Contact& contact) : f_max(contact.solid_fraction_max) {}
  explicit Collisions(const Scene& scene)
      : radial(scene.model.radial_distribution),
        transport(scene.model.kinetic_transport),
        correlated(scene.model.correlated_collisions),
        f_max(scene.contact.solid_fraction_max),
        amplitude(jamming_amplitude(scene.solid.friction)) {}

  double g0(double f_s) const {
    return radial == RadialDistribution::paper ? radial_distribution(f_s, f_max)
                                               : radial_distribution_jamming(f_s, f_max, amplitude);
  }
  double g0_slope(double f_s) const {
    return radial == RadialDistribution::paper ? radial_distribution_slope(f_s, f_max)
                                               : radial_distribution_jamming_slope(f_s, f_max, amplitude);
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
    const double g = g0(f_s),
                 factor = transport == KineticTransport::collisional ? 1.0 : streaming_viscosity(f_s, e, g);
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
    return transport == KineticTransport::collisional ? closures::conductivity_to_viscosity
                                                      : streaming_conductivity_to_viscosity(f_s, e, g0(f_s));
  }
};

}  // namespace granvof::closures
