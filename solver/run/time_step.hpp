// One time step of the gas-liquid-solid model: the algorithm, one named operator a line.
#pragma once

#include <optional>
#include <string>

#include "solver/operators/aperture.hpp"
#include "solver/operators/continuity_tree.hpp"
#include "solver/operators/coupled_pressure.hpp"
#include "solver/operators/friction.hpp"
#include "solver/operators/granular_temperature.hpp"
#include "solver/operators/implicit_viscosity.hpp"
#include "solver/operators/interface_transport.hpp"
#include "solver/operators/interphase_drag.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/viscosity.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/run/state.hpp"
#include "solver/run/stopwatch.hpp"

namespace granvof {

struct StepReport {
  bool accepted = false;
  std::string refused_because;  // empty if accepted
  bool not_finite = false;      // and what it was refused for is that something was not finite
  PressureReport pressure;
  linear::Report friction;
  double liquid_left = 0.0, solid_left = 0.0;  // volumes that left through sides, net [m3]
};

// Accelerations beside gravity, on the faces of each direction [m/s2]: the sources of a manufactured
// solution.
struct BodyAcceleration {
  FaceField solid, fluid;
};

class TimeStep {
 public:
  TimeStep(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // Tries one step from `now` (ghosts filled) to `next`. `now` is never touched; `next` is meaningful, with
  // ghosts filled, only if the report says accepted.
  StepReport advance(const State& now, double dt, State& next, const BodyAcceleration* extra = nullptr);

  const Stopwatch& cost() const { return cost_; }

 private:
  void stir_grains(const State& now, double dt);
  void predict(const State& now, double dt);
  void add_to_predictor(const BodyAcceleration& extra, double dt);
  void apply_friction(const State& now, double dt, State& next, StepReport& report);
  bool bears_explicit_viscosity(double dt) const;
  bool apply_viscosity(const State& now, double dt, State& next);
  void dilate(double dt, State& next);
  void account_energy(const State& now, double dt, const Friction::Power& stress,
                      const GranularLosses& granular, double carried, const LiquidPassed& passed,
                      State& next);
  std::string reason_to_refuse(const State& now, double dt, const StepReport& report) const;

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  Aperture aperture_;
  FaceInertia inertia_;
  InterphaseDrag drag_;
  Rheology rheology_;
  FluidViscosity viscosity_;
  std::optional<ImplicitViscosity> implicit_viscosity_;  // of the first step that needs it on
  Friction friction_;
  CoupledPressure pressure_;
  InterfaceTransport interface_;
  GranularTemperature temperature_;
  StrainRate strain_;
  bool whole_columns_;  // else the tree closes continuity
  ContinuityTree continuity_tree_;
  EnergyBudget budget_;
  FaceField predicted_s_, predicted_c_;  // explicit predictors [m/s]
  FaceField convective_c_;               // convective part of the fluid's [m/s2]
  double upwind_ = 0.0;                  // power that the upwinding of both momenta takes [W]
  double viscous_power_ = 0.0;           // of the explicit viscous force [W]
  FaceField mass_, rhs_;                 // of the implicit solid momentum
  FaceField flux_s_, flux_c_;            // f_s u_s, f_c u_c through the faces [m/s]
  FaceField flux_c_solved_;              // f_c u_c before continuity was closed
  Field stirred_;                        // Theta that the kinetic viscosity is taken at [m2/s2]
  Field production_;                     // of Theta: what the kinetic stress dissipates [W/m3]
  double kinematic_viscosity_ = 0.0;     // largest of the fluid, LES included [m2/s]
  Stopwatch cost_;
};

}  // namespace granvof
