// Where the energy of a coupled run goes, in the terms of the continuum (solver/state/energy_terms.hpp) as
// far as both have them.
//
// Each term is measured by itself: the beads' from their forces and speeds in every DEM step, the fluid's
// from the terms of its momentum equation in every fluid step, stored energies from the state. So the budget
//   change of (kinetic + potential + granular + spin + elastic)
//     = gate - contacts - walls - drag - viscosity - outflow - numerical_... + residual
// closes only where nothing is left out: `residual` is the check.
#pragma once

#include <array>

#include "reference/demvof/coupling/coupled_run.hpp"

namespace demvof {

// [J]; losses are positive when the flow loses energy.
struct EnergyTerms {
  double kinetic = 0.0;    // of the fluid, and of the beads' mean motion, cell by cell of the mapping
  double potential = 0.0;  // of beads, liquid and gas
  double granular = 0.0;   // of the beads' motion about that mean: 3/2 f_s rho_s Theta
  double spin = 0.0;       // of the beads' rotation
  double elastic = 0.0;    // normal springs of the contacts

  double contacts = 0.0;        // dissipated between beads, frozen ones included: friction and collisions
  double walls = 0.0;           // dissipated at planes, obstacles and plate
  double drag = 0.0;            // taken from the beads less given to the fluid
  double drag_mean = 0.0;       // of which on the mean motion of the beads; the rest is on their agitation
  double viscosity = 0.0;       // of the fluid, LES included
  double outflow = 0.0;         // carried out through the top
  double gate = 0.0;            // given by what raises the plate (a gain)
  double numerical_time = 0.0;  // the fluid's implicit step: 1/2 m |u_new - u_old|^2
  double numerical_momentum = 0.0;  // its convection scheme
  double numerical_fluid = 0.0;  // weight that the flux of liquid and gas moved otherwise than their velocity
  // Work of the pressure on beads and fluid together, which would be none in a closed tank were both of the
  // same instant and place: lag of a step, mapping, the beads' gradient in cells and the fluid's on faces.
  double numerical_pressure = 0.0;
  double residual = 0.0;

  double stored() const { return kinetic + potential + granular + spin + elastic; }
  double lost() const {
    return contacts + walls + drag + viscosity + outflow + numerical_time + numerical_momentum +
           numerical_fluid + numerical_pressure - gate;
  }
};

struct EnergyTerm {
  const char* name;
  double EnergyTerms::*value;
  const char* meaning;
};

inline constexpr std::array energy_terms{
    EnergyTerm{"energy_kinetic", &EnergyTerms::kinetic, "kinetic energy of the mean motion, both phases"},
    EnergyTerm{"energy_potential", &EnergyTerms::potential, "potential energy of all phases above the floor"},
    EnergyTerm{"energy_granular", &EnergyTerms::granular, "fluctuation energy of the grains"},
    EnergyTerm{"energy_spin", &EnergyTerms::spin, "rotational energy of the grains"},
    EnergyTerm{"energy_elastic", &EnergyTerms::elastic, "energy stored by the contacts' normal springs"},
    EnergyTerm{"lost_contacts", &EnergyTerms::contacts,
               "dissipated between grains so far, friction and collisions"},
    EnergyTerm{"lost_walls", &EnergyTerms::walls,
               "dissipated between grains and planes, obstacles and the gate's plate, so far"},
    EnergyTerm{"lost_drag", &EnergyTerms::drag, "dissipated by drag so far"},
    EnergyTerm{"part_drag_mean", &EnergyTerms::drag_mean, "of lost_drag, on the mean motion of the grains"},
    EnergyTerm{"lost_viscosity", &EnergyTerms::viscosity,
               "dissipated by the fluid's viscosity so far, LES included"},
    EnergyTerm{"lost_outflow", &EnergyTerms::outflow, "carried out through the top so far"},
    EnergyTerm{"gained_gate", &EnergyTerms::gate, "given by what raises the gate so far"},
    EnergyTerm{"lost_numerical_time", &EnergyTerms::numerical_time, "lost to implicit time steps so far"},
    EnergyTerm{"lost_numerical_momentum", &EnergyTerms::numerical_momentum,
               "lost to momentum transport so far"},
    EnergyTerm{"lost_numerical_fluid", &EnergyTerms::numerical_fluid, "lost to volume transport so far"},
    EnergyTerm{"lost_numerical_pressure", &EnergyTerms::numerical_pressure,
               "lost to the exchange of pressure between grains and fluid so far"},
    EnergyTerm{"energy_residual", &EnergyTerms::residual, "what the budget does not account for so far"},
};

class EnergyLedger {
 public:
  explicit EnergyLedger(const CoupledRun& run);
  // Losses count from now on.
  void begin();
  EnergyTerms terms() const;

 private:
  const CoupledRun& run_;
  EnergyTerms at_begin_;
  EnergyTerms totals() const;  // since the run was made, without what is derived
};

}  // namespace demvof
