#include "reference/demvof/coupling/energy_ledger.hpp"

#include <cstddef>
#include <vector>

namespace demvof {

namespace {

// Kinetic energy of the beads' mean motion, cell by cell [J].
double mean_motion(const CoupledRun& run) {
  const BeadState& beads = run.beads().state();
  const std::size_t cells = run.mapping().cell_count();
  const double mass = run.beads().bead_mass();
  std::vector<double> number(cells, 0.0), squares(cells, 0.0);
  run.mapping().deposit(1.0, number);
  for (int d = 0; d < 3; ++d) {
    std::vector<double> sum(cells, 0.0);
    run.mapping().deposit(beads.velocity, 3, d, sum);
    for (std::size_t c = 0; c < cells; ++c) squares[c] += sum[c] * sum[c];
  }
  double energy = 0.0;
  for (std::size_t c = 0; c < cells; ++c) {
    if (number[c] > 0.0) energy += 0.5 * mass * squares[c] / number[c];
  }
  return energy;
}

}  // namespace

EnergyLedger::EnergyLedger(const CoupledRun& run) : run_(run) {
  begin();
}

EnergyTerms EnergyLedger::totals() const {
  const BeadEngine& beads = run_.beads();
  const Fluid& fluid = run_.fluid();
  const BeadWork& work = beads.work();
  const FluidWork& on_fluid = fluid.work();
  const ElasticEnergy elastic = beads.elastic_energy();
  EnergyTerms t;
  const double mean = mean_motion(run_);
  t.kinetic = mean + fluid.kinetic_energy();
  t.granular = beads.translation_energy() - mean;
  t.potential = beads.potential_energy() + fluid.potential_energy();
  t.spin = beads.spin_energy();
  t.elastic = elastic.beads + elastic.walls;
  // What the contacts took and do not hold.
  t.contacts = -work.contacts - elastic.beads;
  t.gate = work.gate_drive;
  t.walls = work.gate_drive - work.walls - work.surfaces - elastic.walls;
  const double pressure = run_.pressure_work();
  t.drag = -(work.drag + work.force - pressure) - on_fluid.drag;
  t.drag_mean = run_.mean_slip_work();
  t.viscosity = on_fluid.viscosity;
  t.outflow = on_fluid.outflow;
  t.numerical_time = on_fluid.numerical_time;
  t.numerical_momentum = on_fluid.numerical_momentum;
  t.numerical_fluid = -fluid.potential_energy() - on_fluid.gravity;
  t.numerical_pressure = -pressure - on_fluid.pressure;
  return t;
}

void EnergyLedger::begin() {
  at_begin_ = totals();
}

EnergyTerms EnergyLedger::terms() const {
  EnergyTerms now = totals();
  for (double EnergyTerms::*loss :
       {&EnergyTerms::contacts, &EnergyTerms::walls, &EnergyTerms::drag, &EnergyTerms::drag_mean,
        &EnergyTerms::viscosity, &EnergyTerms::outflow, &EnergyTerms::gate, &EnergyTerms::numerical_time,
        &EnergyTerms::numerical_momentum, &EnergyTerms::numerical_fluid, &EnergyTerms::numerical_pressure})
    now.*loss -= at_begin_.*loss;
  now.residual = now.stored() - at_begin_.stored() + now.lost();
  return now;
}

}  // namespace demvof
