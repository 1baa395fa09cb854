// The terms of the energy budget: the one table of what each is called, means, and where it is measured.
// Equations: docs/theory/contact.md, docs/theory/kinetic-theory.md.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "solver/scene/parts.hpp"

namespace granvof {

// Energies of a state and what changed them, all in J. Stored energies are those of the present state, all
// other terms add up over the steps. Every term is measured by itself, from the fluxes and forces of the
// operator it belongs to; none is what the others leave, but the residual:
//   residual = change of (kinetic + potential + granular + elastic)
//              - walls - dense_excess - shear_dilatancy + outflow + drag + friction + viscosity + collisions
//              + sum(numerical).
// A loss is positive when the flow loses energy by it. Numerical terms are what a scheme does beside the
// physical work of its operator; see energy_terms below and docs/theory/energy.md.
struct EnergyTerms {
  double kinetic = 0.0, potential = 0.0, granular = 0.0, elastic = 0.0;
  double drag = 0.0, friction = 0.0, viscosity = 0.0, collisions = 0.0, outflow = 0.0;
  double walls = 0.0, dense_excess = 0.0, shear_dilatancy = 0.0;
  double numerical_time = 0.0, numerical_momentum = 0.0, numerical_solid = 0.0, numerical_fluid = 0.0;
  double numerical_viscosity = 0.0, numerical_stress = 0.0, numerical_elastic = 0.0;
  double numerical_granular = 0.0;
  double upwind_momentum = 0.0, theta_bounds = 0.0;
  double residual = 0.0;

  double stored() const { return kinetic + potential + granular + elastic; }
  double physical() const { return drag + friction + viscosity + collisions; }
  double in_motion() const { return kinetic + granular; }
  // Through the sides; nothing where more was put in than left.
  double carried_out() const { return outflow > 0.0 ? outflow : 0.0; }
  double numerical() const;            // the sum of the numerical terms
  double numerical_magnitude() const;  // of their magnitudes
  // What came from nowhere: every numerical term that is a gain, and the work of solid pressure that nothing
  // pays for. What one scheme takes does not make up for what another gives.
  double created() const;
  // What went nowhere: every numerical term that is a loss.
  double destroyed() const;
  // Stored less what the terms put there: what is not accounted for of a step that began at `before` [J].
  double left_by(const EnergyTerms& before) const;
  // Takes the terms of a step that led from the present state.
  void add(const EnergyTerms& step);
};

enum class EnergyKind {
  stored,      // of the present state
  dissipated,  // by the physics of the model
  outside,     // passes the sides, or what nothing inside pays for
  numerical,   // what a scheme adds
  part,        // of another term
  residual,
};

constexpr const char* name_of(EnergyKind kind) {
  constexpr std::array names{"stored", "dissipated", "outside", "numerical", "part", "residual"};
  return names[static_cast<std::size_t>(kind)];
}

struct EnergyTerm {
  const char* name;  // column of series.csv, key of run.json
  double EnergyTerms::*value;
  const Part& part;  // whose work it is
  EnergyKind kind;
  int sign;                 // in the sum of changes and losses that vanishes but for the residual
  bool never_gains;         // a loss by its form
  const char* label;        // in figures
  const char* meaning;      // one line
  const char* measured_in;  // the file that measures it
};

// Every term; the stored ones come first.
inline constexpr int stored_energy_terms = 4;
inline constexpr std::array energy_terms{
    EnergyTerm{"energy_kinetic", &EnergyTerms::kinetic, parts::momentum, EnergyKind::stored, 1, false,
               "kinetic, both phases", "kinetic energy of the mean motion, both phases, on faces",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"energy_potential", &EnergyTerms::potential, parts::momentum, EnergyKind::stored, 1, false,
               "potential, all phases", "potential energy of solid, liquid and gas above the floor",
               "solver/run/energy_budget.cpp"},
    EnergyTerm{"energy_granular", &EnergyTerms::granular, parts::granular_temperature, EnergyKind::stored, 1,
               false, "granular", "fluctuation energy of the grains, 3/2 f_s rho_s Theta",
               "solver/run/energy_budget.cpp"},
    EnergyTerm{"energy_elastic", &EnergyTerms::elastic, parts::solid_pressure, EnergyKind::stored, 1, false,
               "elastic, contacts", "stored by the contact pressure (13)", "solver/run/energy_pressure.cpp"},
    EnergyTerm{"lost_drag", &EnergyTerms::drag, parts::drag, EnergyKind::dissipated, 1, true, "drag",
               "dissipated by drag so far: beta |u_s - u_c|^2, and 3 beta Theta",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_friction", &EnergyTerms::friction, parts::friction, EnergyKind::dissipated, 1, true,
               "contact friction", "dissipated by contact friction (17) so far",
               "solver/operators/friction_power.cpp"},
    EnergyTerm{"lost_viscosity", &EnergyTerms::viscosity, parts::fluid_viscosity, EnergyKind::dissipated, 1,
               true, "fluid viscosity, LES", "dissipated by the fluid's viscosity so far, LES included",
               "solver/operators/viscosity.cpp"},
    EnergyTerm{"lost_collisions", &EnergyTerms::collisions, parts::granular_temperature,
               EnergyKind::dissipated, 1, true, "collisions", "dissipated by collisions (23) so far",
               "solver/operators/granular_temperature.cpp"},
    EnergyTerm{"lost_outflow", &EnergyTerms::outflow, parts::outlet, EnergyKind::outside, 1, false,
               "carried out, net",
               "carried out through the sides so far, less the work of the pressure on them and of gravity "
               "along periodic directions",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"gained_walls", &EnergyTerms::walls, parts::walls, EnergyKind::outside, -1, false,
               "moving walls", "given by moving walls so far", "solver/operators/stress_power.hpp"},
    EnergyTerm{"gained_dilatancy", &EnergyTerms::dense_excess, parts::solid_pressure, EnergyKind::outside, -1,
               false, "uncharged solid pressure",
               "work of the solid pressure so far that nothing pays for: of P_s^EF (14), which (7) does not "
               "charge to Theta",
               "solver/run/energy_pressure.cpp"},
    EnergyTerm{"gained_shear_dilatancy", &EnergyTerms::shear_dilatancy, parts::packing, EnergyKind::outside,
               -1, false, "shear dilatancy",
               "given to the contacts so far by shear that dilates the bed: what friction takes by tan(psi)",
               "solver/run/energy_budget.cpp"},
    EnergyTerm{"lost_numerical_time", &EnergyTerms::numerical_time, parts::momentum, EnergyKind::numerical, 1,
               true, "numerics: implicit steps",
               "lost to implicit time steps so far: 1/2 m |u^{n+1} - u^n|^2", "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_numerical_momentum", &EnergyTerms::numerical_momentum, parts::momentum,
               EnergyKind::numerical, 1, false, "numerics: momentum transport",
               "lost to momentum transport so far: upwind differences, and mass that crosses faces without "
               "its momentum",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_numerical_solid", &EnergyTerms::numerical_solid, parts::grains_transport,
               EnergyKind::numerical, 1, false, "numerics: transport of grains",
               "lost so far to what the flux of grains adds to the mean of a face, |u| h / 2 times the "
               "gradient of f_s where it is upwind, against gravity and fluid pressure",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_numerical_fluid", &EnergyTerms::numerical_fluid, parts::interface, EnergyKind::numerical,
               1, false, "numerics: transport of liquid and gas",
               "lost so far to what the fluxes of liquid and gas add to the mean of a face, against gravity "
               "and fluid pressure",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_numerical_viscosity", &EnergyTerms::numerical_viscosity, parts::fluid_viscosity,
               EnergyKind::numerical, 1, false, "numerics: viscous steps",
               "lost so far to viscous forces of one velocity that work on another",
               "solver/run/energy_faces.cpp"},
    EnergyTerm{"lost_numerical_stress", &EnergyTerms::numerical_stress, parts::friction,
               EnergyKind::numerical, 1, false, "numerics: split solid stress",
               "lost so far to solid stresses of the velocity before the pressure step that work on the one "
               "after it",
               "solver/operators/friction_power.cpp"},
    EnergyTerm{
        "lost_numerical_elastic", &EnergyTerms::numerical_elastic, parts::solid_pressure,
        EnergyKind::numerical, 1, false, "numerics: contact pressure",
        "what the elastic pressure took from the motion so far and the contacts do not store: the flux "
        "of grains beside the mean of a face, and implicit steps",
        "solver/run/energy_pressure.cpp"},
    EnergyTerm{"lost_numerical_granular", &EnergyTerms::numerical_granular, parts::granular_temperature,
               EnergyKind::numerical, 1, false, "numerics: $\\Theta$",
               "lost so far by Theta at its bounds and where grains run out, less what it was spared where "
               "they expand by more than they hold; all changes of a Theta in steady balance",
               "solver/operators/granular_temperature.cpp"},
    EnergyTerm{"upwind_momentum_took", &EnergyTerms::upwind_momentum, parts::momentum, EnergyKind::part, 0,
               false, "of which upwind differences",
               "part of lost_numerical_momentum: |u| h / 2 times the second difference, or what limiters "
               "leave of it",
               "solver/operators/convection.cpp"},
    EnergyTerm{"theta_bounds_took", &EnergyTerms::theta_bounds, parts::granular_temperature, EnergyKind::part,
               0, true, "of which bounds on $\\Theta$",
               "part of lost_numerical_granular: taken by the bounds on Theta",
               "solver/operators/granular_temperature.cpp"},
    EnergyTerm{"energy_residual", &EnergyTerms::residual, parts::ledger, EnergyKind::residual, -1, false,
               "not accounted for",
               "not accounted for so far: the change of all stored energy less all the other terms",
               "solver/state/energy_terms.hpp"},
};

inline double EnergyTerms::numerical() const {
  double sum = 0.0;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == EnergyKind::numerical) sum += this->*term.value;
  return sum;
}

inline double EnergyTerms::numerical_magnitude() const {
  double sum = 0.0;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == EnergyKind::numerical) sum += std::fabs(this->*term.value);
  return sum;
}

inline double EnergyTerms::created() const {
  double sum = dense_excess > 0.0 ? dense_excess : 0.0;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == EnergyKind::numerical && this->*term.value < 0.0) sum -= this->*term.value;
  return sum;
}

inline double EnergyTerms::destroyed() const {
  double sum = 0.0;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == EnergyKind::numerical && this->*term.value > 0.0) sum += this->*term.value;
  return sum;
}

inline double EnergyTerms::left_by(const EnergyTerms& before) const {
  double left = 0.0;
  for (const EnergyTerm& term : energy_terms) {
    if (term.kind == EnergyKind::residual) continue;
    const double change =
        term.kind == EnergyKind::stored ? this->*term.value - before.*term.value : this->*term.value;
    left += term.sign * change;
  }
  return left;
}

inline void EnergyTerms::add(const EnergyTerms& step) {
  for (const EnergyTerm& term : energy_terms) {
    if (term.kind == EnergyKind::stored)
      this->*term.value = step.*term.value;
    else
      this->*term.value += step.*term.value;
  }
}

}  // namespace granvof
