// Beads and fluid advanced together, momentum handed over as impulses.
//
// One step of length T: beads move under the pressure gradient and drag of the last fluid step; the impulse
// that each bead took through drag is K (u_f T - dx), dx its displacement, since the drag was re-evaluated
// every DEM step; the fluid gets its opposite, and the new void fraction. The implicit part of the fluid's
// drag, K (u_f,new - u_f,old) T, is handed to the beads in the next step, so that over a run the two sides
// exchange exactly what they lose and gain but for one step's lag.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "reference/demvof/beads/bead_engine.hpp"
#include "reference/demvof/coupling/mapping.hpp"
#include "reference/demvof/fluid/fluid.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

struct CouplingSettings {
  double fluid_dt = 2e-4;     // longest fluid step [s]; shortened where the liquid would move half a cell
  bool drag = true;           // false: pressure gradient alone
  granvof::DragLaw drag_law;  // the continuum's closure, see closures/drag/drag.hpp
  // Bead's over grain's diameter [-], >= 1: a bead of diameter k d stands for k^3 grains of diameter d and
  // has the drag of them all.
  double coarse_graining = 1.0;
  // Pressure on the beads predicted with their inertia in the equation, instead of that of the last fluid
  // step. Needed where (f_s / rho_s) / (f_c / rho_c) exceeds about 1: beads not much heavier than the liquid.
  // What the prediction missed is handed over in the next step.
  bool predict_pressure = false;
  // Face x = closed_gate * spacing on which a gate stands closed at the start. Set later it would change the
  // mapping of the beads beside it at once: a source of volume that blows column and water apart.
  std::optional<int> closed_gate;
};

class CoupledRun {
 public:
  CoupledRun(const CouplingSettings& settings, const BeadSettings& beads, const BeadState& mobile,
             const std::vector<double>& frozen_positions, const FluidSettings& fluid,
             const std::vector<double>& alpha);

  // One step as long as the flow allows (a multiple of the DEM step, at least one), at most longest_step().
  // Returns its length [s]. Throws std::runtime_error when either side fails.
  double step();
  // The same on the way to an event that is `left` [s] away: in equal shares, as long as the flow allows.
  double step(double left);
  double longest_step() const { return std::max(settings_.fluid_dt, beads_->settings().dt); }  // [s]

  // The gate's lower edge stands at `edge` [m] over the floor for the fluid; <= 0 closed.
  // The beads' plate is moved by the bead engine.
  void set_gate_edge(int face, double edge);
  void remove_gate();

  double time() const { return time_; }
  BeadEngine& beads() { return *beads_; }
  const BeadEngine& beads() const { return *beads_; }
  const Fluid& fluid() const { return *fluid_; }
  const std::vector<double>& solid_fraction() const { return solid_fraction_; }
  const Mapping& mapping() const { return mapping_; }
  const FluidLoad& load() const { return load_; }
  // Momentum of beads and fluid [kg m/s]; what is on its way between them (drag carried over, the pressure of
  // the last fluid step) counts with the beads.
  Vector momentum() const;
  // Of the pressure on the beads since the start [J]; what else the fluid did to them is drag.
  double pressure_work() const { return pressure_work_; }
  // What drag would have dissipated since the start had each bead moved as the mean of the beads about it
  // [J]; what it took beyond is the drag on their agitation.
  double mean_slip_work() const { return mean_slip_work_; }

 private:
  CouplingSettings settings_;
  FluidSettings fluid_settings_;
  Mapping mapping_;
  std::unique_ptr<BeadEngine> beads_;
  std::unique_ptr<Fluid> fluid_;
  std::vector<double> predicted_;       // force by the predicted pressure in the next step [N], three a bead
  FluidLoad load_;                      // what the beads will feel in the next step, carry left out
  std::vector<double> carry_;           // impulse owed to the beads [N s], three a bead
  std::vector<double> solid_fraction_;  // a cell
  BeadLoad reaction_;
  double time_ = 0.0;
  double last_duration_ = 0.0;
  double pressure_work_ = 0.0;
  double mean_slip_power_ = 0.0, mean_slip_work_ = 0.0;  // of the step to come [W]; [J]

  void deposit_solid_fraction();
  void predict_pressure_force();
  void renew_load();
  void renew_drag();
  double mean_slip_power() const;
  long bead_steps_allowed() const;
  double advance(int bead_steps);
  std::vector<double> displacement(const std::vector<double>& old_position) const;
  std::vector<double> drag_impulse(const std::vector<double>& moved, double duration) const;
};

}  // namespace demvof
