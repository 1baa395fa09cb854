// Where the energy of a step goes: the discrete work of every operator, measured where it acts.
//
// The whole step solves, on every face and for both phases together with what was solved for,
//   m (u^{n+1} - u^n) / dt = convection + viscosity(u^n) + gravity + friction(u') -+ beta (u_s - u_c)
//                            - f grad P_c - grad P_s          (all of level n+1 but where stated),
// u' the velocity after the friction step. Each operator states what it did to the energy from its own fluxes
// and forces: its physical work, and apart from it what its scheme adds. What all of them together do not
// make of the change that is stored is the residual: momentum (friction solve, drag, pressure response) or
// continuity that was not solved, and work that an operator misstates. See docs/theory/energy.md.
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/closures/elastic_energy.hpp"
#include "solver/operators/friction.hpp"
#include "solver/operators/granular_temperature.hpp"
#include "solver/operators/liquid_passed.hpp"
#include "solver/operators/momentum_predictor.hpp"
#include "solver/operators/viscosity.hpp"
#include "solver/state/energy_terms.hpp"
#include "solver/state/state.hpp"

namespace granvof {

// What a step leaves behind for its account.
struct StepTrace {
  const closures::SolidLaw& law;
  const FaceInertia& inertia;  // of the old level
  const FaceField& beta;       // [kg/m3 s]
  const MomentumPredictor& predictor;
  const FaceField &flux_s, &flux_c;  // [m/s]
  const FaceField& flux_c_solved;    // before it closed continuity: what the velocities carry [m/s]
  const Rheology& rheology;          // of the old level
  const StrainRate& strain;          // of the new u_s
  double viscous_power;              // of the viscous force at the velocity that `viscous` is of [W]
  const FluidViscosity::Power& viscous;
  const Friction::Power& stress;
  const GranularLosses& granular;
  const Field& packing;  // at which the grains touched in the pressure step
  double carried;        // elastic energy of the new level [J]
  const LiquidPassed& passed;
};

class EnergyBudget {
 public:
  EnergyBudget(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // Stored energies of a state whose ghosts are filled.
  EnergyTerms stored(const State& s) const;
  // Stored by the contact pressure (13) [J].
  double elastic(const Field& f_s, const Field& packing) const;
  // Terms of the step from `now`, whose energy is known, to `next`; ghosts of both filled.
  EnergyTerms of_step(double dt, const State& now, const State& next, const StepTrace& trace) const;

 private:
  double potential_energy(const State& s) const;
  double granular_energy(const State& s) const;
  // Work of the kinetic and dense pressures of the step on the grains [J].
  double work_of_flow_pressure(double dt, const State& now, const State& next, const StepTrace& trace) const;
  // The same of the elastic pressure.
  double work_of_contacts(double dt, const State& now, const State& next, const StepTrace& trace) const;
  // Energy that the contacts got by the shear of the step [J].
  double given_by_shear(const State& now, const State& next, const StepTrace& trace) const;
  const Field& fraction_of_law(const State& now, const State& next) const;

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  closures::ElasticEnergy elastic_energy_;
};

}  // namespace granvof
