// Where the energy of a step goes: the discrete work of every operator, measured where it acts.
//
// The whole step solves, on every face and for both phases together with what was solved for,
//   m (u^{n+1} - u^n) / dt = convection + viscosity(u^n) + gravity + friction(u') -+ beta (u_s - u_c)
//                            - f grad P_c - grad P_s          (all of level n+1 but where stated),
// u' the velocity after the friction step. Times u^{n+1} and summed this is an identity: each term is
// computed by itself from the states before and after, and what does not cancel is the residual, i.e.
// momentum (friction solve, drag, pressure response) or continuity that was not solved. Numerical dissipation
// is the stated difference between the work of a discrete operator and the physical term it stands for.
#pragma once

#include "solver/closures/elastic_energy.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/friction.hpp"
#include "solver/operators/granular_temperature.hpp"
#include "solver/operators/side_liquid.hpp"
#include "solver/operators/viscosity.hpp"
#include "solver/run/energy_terms.hpp"
#include "solver/run/state.hpp"

namespace granvof {

// What a step leaves behind for its account.
struct StepTrace {
  const FaceInertia& inertia;                  // of the old level
  const FaceField& beta;                       // [kg/m3 s]
  const FaceField &predicted_s, &predicted_c;  // explicit predictors [m/s]
  const FaceField &flux_s, &flux_c;            // [m/s]
  const FaceField& flux_c_solved;              // before it closed continuity: what the velocities carry [m/s]
  const Rheology& rheology;                    // of the old level
  const StrainRate& strain;                    // of the new u_s
  const FluidViscosity::Power& viscous;
  const Friction::Power& stress;
  const GranularLosses& granular;
  double dilated;  // elastic energy that shear put into the contacts by their packing [J]
  const SideLiquid& passed;
};

class EnergyBudget {
 public:
  EnergyBudget(const Grid& grid, const Scene& scene, const Boundary& boundary)
      : grid_(grid),
        scene_(scene),
        side_pressure_(boundary.side_pressure()),
        elastic_energy_(scene.contact) {}

  // Stored by the contact pressure (13) [J].
  double elastic(const Field& f_s, const Field& packing) const;
  // Stored energies of a state whose ghosts are filled.
  EnergyTerms stored(const State& s) const;
  // Terms of the step from `now`, whose energy is known, to `next`; ghosts of both filled.
  EnergyTerms of_step(double dt, const State& now, const State& next, const StepTrace& trace) const;

 private:
  struct FaceWork;
  FaceWork work_on_faces(double dt, const State& now, const State& next, const StepTrace& trace) const;
  void add_solid(double dt, int d, const State& now, const State& next, const StepTrace& trace,
                 FaceWork& work) const;
  void add_fluid(double dt, int d, const Range& faces, double weight, const State& now, const State& next,
                 const StepTrace& trace, FaceWork& work) const;
  void add_side(double dt, int d, bool upper, const StepTrace& trace, const State& now, const State& next,
                FaceWork& work) const;
  // `momentum`: the sum of m u over faces of direction d [kg/m2 s], each of the same volume [m3].
  void add_gravity(double dt, int d, double volume, double momentum, FaceWork& work) const;
  EnergyTerms in_cells(const State& s) const;  // stored energies but the kinetic one
  double potential_energy(const State& s) const;
  // Work of the elastic and of the kinetic pressure on the grains in dt [J].
  struct PressureWork {
    double elastic = 0.0, kinetic = 0.0;
  };
  PressureWork pressure_work(double dt, const State& now, const State& next, const StepTrace& trace) const;

  const Grid& grid_;
  const Scene& scene_;
  const double* side_pressure_;  // Boundary::side_pressure()
  closures::ElasticEnergy elastic_energy_;
};

}  // namespace granvof
