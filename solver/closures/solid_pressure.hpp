// Total solid pressure P_s = P_s^K + P_s^ES + P_s^EF of a cell, eqs (11)-(15), as a function of f_s alone.
//
// Theta and e are those of the old level; the implicit step needs P_s and its slope at any trial f_s.
// Equations: docs/theory/contact.md, docs/theory/kinetic-theory.md.
#pragma once

#include "solver/closures/collisions.hpp"
#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/suspension.hpp"

namespace granvof::closures {

// What is the same in all cells of a scene, which makes it once (TimeStep). With `dense_excess` P_s^EF =
// max(P_s^D - P_s^K, 0) of (14) is included.
struct SolidLaw {
  double rho_s = 0.0;  // [kg/m3]
  Contact contact;
  bool dense_excess = true;
  Collisions collisions;

  SolidLaw(double density, const Contact& c, bool with_dense_excess)
      : rho_s(density), contact(c), dense_excess(with_dense_excess), collisions(c) {}
  explicit SolidLaw(const Scene& scene)
      : rho_s(scene.solid.density),
        contact(scene.contact),
        dense_excess(scene.model.dense_excess),
        collisions(scene) {}
};

// What fixes P_s(f_s) in a cell during one step.
struct GrainsOfCell {
  double theta = 0.0;           // [m2/s2], >= 0
  double e = 0.0;               // [-], in [0, 1]
  double resting = 0.0;         // P_s^W > 0 [Pa], the weight of grains at rest in a partly filled cell
                                // (operators/bed_surface.hpp)
  double packing = 0.0;         // where the grains touch, see elastic_pressure() [-]
  double viscous_stress = 0.0;  // mu_c gamma of viscous_contact_pressure() [Pa]; 0 without
};

// P_s^D of (15), over the correlation length of dense collisions where they are correlated: Theta of a steady
// shear is larger then by as much. L stays where (15) is capped, so that the pressure never falls with f_s.
inline PressureAndSlope dense_pressure(double f_s, const GrainsOfCell& cell, const SolidLaw& law) {
  PressureAndSlope p = dense_pressure(f_s, cell.theta, cell.e, law.rho_s, law.contact, cell.packing);
  if (!law.collisions.correlated || p.value <= 0.0) return p;
  const double capped =
      law.contact.dense_solid_fraction + (cell.packing - law.contact.solid_fraction_min) - dense_pressure_cap;
  const double at = std::min(f_s, capped), length = law.collisions.correlation(at, cell.e);
  const double falls = f_s < capped ? law.collisions.correlation_log_slope(at, cell.e) : 0.0;
  return {p.value / length, (p.slope - p.value * falls) / length};
}

// What grains in motion, or at rest without touching, bear beside the elastic pressure. f_s >= 0. Kinetic and
// dense parts together are max(P_s^K, P_s^D), with grains at rest max(P_s^K, P_s^D, P_s^W).
inline PressureAndSlope flow_pressure(double f_s, const GrainsOfCell& cell, const SolidLaw& law) {
  PressureAndSlope flow{cell.resting, 0.0};
  if (cell.theta > 0.0 && f_s > 0.0) {
    const double g0 = law.collisions.g0(f_s), e = cell.e;
    const PressureAndSlope kinetic{
        kinetic_pressure(f_s, cell.theta, e, g0, law.rho_s),
        law.rho_s * cell.theta *
            (1.0 + 2.0 * (1.0 + e) * f_s * (2.0 * g0 + f_s * law.collisions.g0_slope(f_s)))};
    if (kinetic.value > flow.value) flow = kinetic;
    if (law.dense_excess) {
      const PressureAndSlope dense = dense_pressure(f_s, cell, law);
      if (dense.value > flow.value) flow = dense;
    }
  }
  return flow;
}

inline PressureAndSlope viscous_pressure(double f_s, const GrainsOfCell& cell, const SolidLaw& law) {
  if (cell.viscous_stress <= 0.0) return {0.0, 0.0};
  return viscous_contact_pressure(f_s, law.contact.solid_fraction_max, cell.viscous_stress);
}

// All that grains bear.
inline PressureAndSlope solid_pressure(double f_s, const GrainsOfCell& cell, const SolidLaw& law) {
  PressureAndSlope p = elastic_pressure(f_s, law.contact, cell.packing);
  for (const PressureAndSlope& more : {flow_pressure(f_s, cell, law), viscous_pressure(f_s, cell, law)}) {
    p.value += more.value;
    p.slope += more.slope;
  }
  return p;
}

// P_s^E = P_s^ES + P_s^EF [Pa], eqs (12)-(14), and that of viscous contacts: the pressure that carries
// friction.
inline double enduring_pressure(double f_s, const GrainsOfCell& cell, const SolidLaw& law) {
  double borne = cell.resting;
  if (cell.theta > 0.0) {
    if (law.dense_excess) borne = std::max(borne, dense_pressure(f_s, cell, law).value);
    const double kinetic = kinetic_pressure(f_s, cell.theta, cell.e, law.collisions.g0(f_s), law.rho_s);
    borne = std::max(borne - kinetic, 0.0);
  }
  if (cell.viscous_stress > 0.0)
    borne += viscous_contact_pressure(f_s, law.contact.solid_fraction_max, cell.viscous_stress).value;
  return elastic_pressure(f_s, law.contact, cell.packing).value + borne;
}

}  // namespace granvof::closures
