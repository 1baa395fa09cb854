// One time step of the gas-liquid-solid model: a list of stages, each an operator or a few.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "solver/operators/aperture.hpp"
#include "solver/operators/continuity_tree.hpp"
#include "solver/operators/coupled_pressure.hpp"
#include "solver/operators/granular_temperature.hpp"
#include "solver/operators/implicit_viscosity.hpp"
#include "solver/operators/interface_transport.hpp"
#include "solver/operators/pressure_level.hpp"
#include "solver/operators/solid_momentum.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/run/stopwatch.hpp"
#include "solver/state/state.hpp"

namespace granvof {

struct StepReport {
  bool accepted = false;
  std::string refused_because;  // empty if accepted
  bool not_finite = false;      // and what it was refused for is that something was not finite
  PressureReport pressure;
  linear::Report friction;
  double liquid_left = 0.0, solid_left = 0.0;  // volumes that left through sides, net [m3]
};

class TimeStep {
 public:
  // Moves the gate of `boundary`.
  TimeStep(const Grid& grid, const Scene& scene, Boundary& boundary);

  // Tries one step from `now` (ghosts filled) to `next`. `now` is never touched; `next` is meaningful, with
  // ghosts filled, only if the report says accepted.
  StepReport advance(const State& now, double dt, State& next, const BodyAcceleration* extra = nullptr);

  // A step that is under way, and what its stages leave each other beside the operators' own fields.
  struct Attempt {
    const State& now;
    double dt;
    State& next;
    const BodyAcceleration* extra;
    StepReport report{};
    double viscous_power = 0.0;            // of the fluid, explicit or implicit [W]
    double elastic = 0.0;                  // stored by contacts once the grains were carried [J]
    const LiquidPassed* passed = nullptr;  // what crossed the faces
    Friction::Power stress{};              // of the solid
    GranularLosses granular{};
  };
  struct Stage {
    const char* cost;                                       // part of the cost that it counts to
    std::array<const Part*, 5> parts;                       // of the model that it serves, then nulls
    const char* does;                                       // in a line
    void (TimeStep::*run)(Attempt&);                        // states why the step is refused, if it is
    bool (TimeStep::*due)(const Attempt&) const = nullptr;  // always, if null
  };
  // The algorithm, in order: docs/theory/numerics.md shows this list.
  static std::span<const Stage> stages();

  const Stopwatch& cost() const { return cost_; }
  // Of the scene, made once: whoever asks for P_s(f_s) asks it.
  const closures::SolidLaw& solid_law() const { return law_; }

 private:
  void move_gate(double time);
  void part_the_fluid();
  void close(Attempt& step);
  void predict(Attempt& step);
  void shear_solid(Attempt& step);
  void diffuse_fluid(Attempt& step);
  void press(Attempt& step);
  void balance_fluxes(Attempt& step);
  void carry_solid(Attempt& step);
  void carry_liquid(Attempt& step);
  void pack(Attempt& step);
  void agitate(Attempt& step);
  void account(Attempt& step);
  // At which the grains touch in the pressure stage.
  const Field& packing_of(const Attempt& step) const {
    return packing_follows_shear(step) ? sheared_packing_ : step.now.packing;
  }
  bool outruns_explicit_viscosity(const Attempt& step) const { return !viscosity_.bears(step.dt); }
  bool holds_grains(const Attempt& /*step*/) const { return inertia_.holds_grains; }
  bool packing_follows_shear(const Attempt& step) const {
    return holds_grains(step) && scene_.model.shear_dilatancy;
  }

  const Grid& grid_;
  const Scene& scene_;
  Boundary& boundary_;
  const closures::SolidLaw law_;
  Aperture aperture_;
  FaceInertia inertia_;
  InterphaseDrag drag_;
  Rheology rheology_;
  FluidViscosity viscosity_;
  MomentumPredictor predictor_;
  SolidMomentum solid_momentum_;
  // Of the first step that needs it on: few scenes do, and it takes an eighth of a run's memory.
  std::optional<ImplicitViscosity> implicit_viscosity_;
  CoupledPressure pressure_;
  InterfaceTransport interface_;
  GranularTemperature temperature_;
  StrainRate strain_;
  bool whole_columns_;  // else the tree closes continuity
  ContinuityTree continuity_tree_;
  PressureLevel pressure_level_;
  EnergyBudget budget_;
  FaceField flux_s_, flux_c_;  // f_s u_s, f_c u_c through the faces [m/s]
  FaceField flux_c_solved_;    // f_c u_c before continuity was closed
  Field sheared_packing_;      // the old one after the shear of the step; empty without shear dilatancy
  Field stirred_;              // Theta that the kinetic viscosity is taken at [m2/s2]
  Field production_;           // of Theta: what the kinetic stress dissipates [W/m3]
  Stopwatch cost_;
};

}  // namespace granvof
