// The terms of the energy budget and their names.
#pragma once

#include <array>

namespace granvof {

// Energies of a state and what changed them, all in J. Stored energies are those of the present state, all
// other terms add up over the steps. A loss is positive when the flow loses energy by it. The budget is
//   change of (kinetic + potential + granular + elastic)
//     = walls + dilatancy + shear_dilatancy - outflow - drag - friction - viscosity - collisions -
//     sum(numerical) + residual.
struct EnergyTerms {
  double kinetic = 0.0;    // of the mean motion of both phases, on faces
  double potential = 0.0;  // of solid, liquid and gas above the floor
  double granular = 0.0;   // 3/2 f_s rho_s Theta
  double elastic = 0.0;    // stored by the contact pressure (13)

  double drag = 0.0;        // beta |u_s - u_c|^2, and 3 beta Theta
  double friction = 0.0;    // Coulomb stress (17)
  double viscosity = 0.0;   // of the fluid, LES included
  double collisions = 0.0;  // gamma_s of (23)
  // Carried out through the sides, less the work of the pressure on them, and of gravity along periodic
  // directions, which have no potential: negative where a flow is driven from outside.
  double outflow = 0.0;
  double walls = 0.0;      // given by moving walls (a gain)
  double dilatancy = 0.0;  // work of P_s^EF (14), which (7) does not charge to Theta (a gain)

  // Given to the contacts by shear that dilates the bed: what friction takes for it by tan(psi) (a gain).
  double shear_dilatancy = 0.0;

  double numerical_time = 0.0;      // implicit steps: 1/2 m |u^{n+1} - u^n|^2
  double numerical_momentum = 0.0;  // upwind momentum, mass that crosses faces without it, explicit viscosity
  // Upwind solid and liquid. The flux of f_s is that of the face's mean less |u| / 2 times the jump across
  // the face, a diffusion: gravity works on the mean mass of the face, and what is spread stays lifted where
  // heavy lies below light. So it is negative (energy made) in stable layers, as the top of a bed is: -g
  // (rho_s - rho_l) |u| / 2 times the jump. It vanishes with the cell: s1 to T = 10, -0.165, -0.082, -0.038,
  // -0.017 J/m on 5, 2.5, 1.25, 0.625 mm.
  double numerical_volume = 0.0;
  double numerical_stress = 0.0;    // friction at the velocity before the pressure step; elastic pressure
  double numerical_granular = 0.0;  // lag between kinetic stress and Theta, and the bounds on Theta
  double theta_bounds = 0.0;        // of which the bounds on Theta alone
  double residual = 0.0;            // what solvers left: momentum and continuity not met

  double stored() const { return kinetic + potential + granular + elastic; }
  double physical() const { return drag + friction + viscosity + collisions; }
  double numerical() const {
    return numerical_time + numerical_momentum + numerical_volume + numerical_stress + numerical_granular;
  }
  // Takes the terms of a step that led from the present state.
  void add(const EnergyTerms& step);
};

struct EnergyTerm {
  const char* name;
  double EnergyTerms::*value;
  const char* meaning;
};

// Every term; the first `stored_energy_terms` are stored, the others add up.
inline constexpr int stored_energy_terms = 4;
inline constexpr std::array energy_terms{
    EnergyTerm{"energy_kinetic", &EnergyTerms::kinetic, "kinetic energy of the mean motion, both phases"},
    EnergyTerm{"energy_potential", &EnergyTerms::potential, "potential energy of all phases above the floor"},
    EnergyTerm{"energy_granular", &EnergyTerms::granular, "fluctuation energy of the grains"},
    EnergyTerm{"energy_elastic", &EnergyTerms::elastic, "energy stored by the contact pressure"},
    EnergyTerm{"lost_drag", &EnergyTerms::drag, "dissipated by drag so far"},
    EnergyTerm{"lost_friction", &EnergyTerms::friction, "dissipated by contact friction so far"},
    EnergyTerm{"lost_viscosity", &EnergyTerms::viscosity,
               "dissipated by the fluid's viscosity so far, LES included"},
    EnergyTerm{"lost_collisions", &EnergyTerms::collisions, "dissipated by collisions so far"},
    EnergyTerm{"lost_outflow", &EnergyTerms::outflow,
               "carried out through the sides so far, net of what drives the flow from outside"},
    EnergyTerm{"gained_walls", &EnergyTerms::walls, "given by moving walls so far"},
    EnergyTerm{"gained_dilatancy", &EnergyTerms::dilatancy, "work of P_s^EF so far, not charged to Theta"},
    EnergyTerm{"gained_shear_dilatancy", &EnergyTerms::shear_dilatancy,
               "given to the contacts by shear that dilates the bed so far"},
    EnergyTerm{"lost_numerical_time", &EnergyTerms::numerical_time, "lost to implicit time steps so far"},
    EnergyTerm{"lost_numerical_momentum", &EnergyTerms::numerical_momentum,
               "lost to momentum transport so far"},
    EnergyTerm{"lost_numerical_volume", &EnergyTerms::numerical_volume, "lost to volume transport so far"},
    EnergyTerm{"lost_numerical_stress", &EnergyTerms::numerical_stress,
               "lost to the splitting of the stress so far"},
    EnergyTerm{"lost_numerical_granular", &EnergyTerms::numerical_granular,
               "lost between stress and Theta so far, bounds included"},
    EnergyTerm{"theta_bounds_took", &EnergyTerms::theta_bounds, "of which taken by the bounds on Theta"},
    EnergyTerm{"energy_residual", &EnergyTerms::residual,
               "left by the solvers so far: the budget closes up to it"},
};

inline void EnergyTerms::add(const EnergyTerms& step) {
  int n = 0;
  for (const EnergyTerm& term : energy_terms) {
    if (n++ < stored_energy_terms)
      this->*term.value = step.*term.value;
    else
      this->*term.value += step.*term.value;
  }
}

}  // namespace granvof
