// Total solid pressure P_s = P_s^K + P_s^ES + P_s^EF of a cell, eqs (11)-(15), as a function of f_s alone.
//
// Theta and e are those of the old level; the implicit step needs P_s and its slope at any trial f_s.
#pragma once

#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/radial_distribution.hpp"

namespace granvof::closures {

// What grains in motion, or at rest without touching, bear beside the elastic pressure. f_s >= 0. With
// `dilatancy` P_s^EF = max(P_s^D - P_s^K, 0) of (14) is included, so that kinetic and dense
// parts together are max(P_s^K, P_s^D); with `resting` = P_s^W > 0 [Pa], the weight of grains at rest in a
// partly filled cell (operators/bed_surface.hpp), max(P_s^K, P_s^D, P_s^W). `packing`: where the grains
// touch, see elastic_pressure().
inline PressureAndSlope flow_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                      bool dilatancy, double resting, double packing) {
  PressureAndSlope flow{resting, 0.0};
  if (theta > 0.0 && f_s > 0.0) {
    const double g0 = radial_distribution(f_s, c.solid_fraction_max);
    const double g0_slope = radial_distribution_slope(f_s, c.solid_fraction_max);
    const PressureAndSlope kinetic{
        kinetic_pressure(f_s, theta, e, g0, rho_s),
        rho_s * theta * (1.0 + 2.0 * (1.0 + e) * f_s * (2.0 * g0 + f_s * g0_slope))};
    if (kinetic.value > flow.value) flow = kinetic;
    if (dilatancy) {
      const PressureAndSlope dense = dense_pressure(f_s, theta, e, rho_s, c, packing);
      if (dense.value > flow.value) flow = dense;
    }
  }
  return flow;
}

// The same with the elastic pressure.
inline PressureAndSlope solid_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                       bool dilatancy, double resting, double packing) {
  PressureAndSlope p = elastic_pressure(f_s, c, packing);
  const PressureAndSlope flow = flow_pressure(f_s, theta, e, rho_s, c, dilatancy, resting, packing);
  p.value += flow.value;
  p.slope += flow.slope;
  return p;
}

inline PressureAndSlope solid_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                       bool dilatancy, double resting = 0.0) {
  return solid_pressure(f_s, theta, e, rho_s, c, dilatancy, resting, c.solid_fraction_min);
}

// P_s^E = P_s^ES + P_s^EF [Pa], eqs (12)-(14): the pressure that carries friction.
inline double enduring_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                bool dilatancy, double resting, double packing) {
  double borne = resting;
  if (theta > 0.0) {
    const double g0 = radial_distribution(f_s, c.solid_fraction_max);
    if (dilatancy) borne = std::max(borne, dense_pressure(f_s, theta, e, rho_s, c, packing).value);
    borne = std::max(borne - kinetic_pressure(f_s, theta, e, g0, rho_s), 0.0);
  }
  return elastic_pressure(f_s, c, packing).value + borne;
}

inline double enduring_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                bool dilatancy, double resting = 0.0) {
  return enduring_pressure(f_s, theta, e, rho_s, c, dilatancy, resting, c.solid_fraction_min);
}

}  // namespace granvof::closures
