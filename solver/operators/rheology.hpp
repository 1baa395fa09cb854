// Cell values of the solid's constitutive law at the old level, eqs (11)-(20).
// Equations: docs/theory/contact.md, docs/theory/kinetic-theory.md.
#pragma once

#include "solver/closures/solid_pressure.hpp"
#include "solver/grid/boundary.hpp"
#include "solver/operators/bed_surface.hpp"
#include "solver/operators/strain.hpp"
#include "solver/state/state.hpp"

namespace granvof {

struct Rheology {
  Field restitution;        // e, eq (18) [-]
  Field kinetic_viscosity;  // f_s mu_s^K [Pa s], eqs (16), (20); also f_s (zeta_s^K - 2/3 mu_s^K), see
                            // friction.hpp
  Field enduring_pressure;  // P_s^E [Pa], eqs (12)-(14)
  Field dilatancy_tangent;  // tan(psi), added to the friction coefficient [-]; 0 without dilatancy friction
  Field arrest_friction;    // least friction coefficient, see thin_layer.hpp [-]; 0 without thin-layer arrest
  Field agitated_drag;      // beta that agitation is dragged by [kg/m3 s]; 0 without agitation drag
  PartCells part_cells;     // grains at rest in partly filled cells; 0 with bed_surface = "whole-cells"
  Field free_side;          // +1, -1: grains at rest fill a part of the cell, and its upper, lower face is
                            // free; else 0 [-]
  // Empty where the scene has none:
  Field half_weight;       // with part-cells: half the weight of a cell's grains, see bed_surface.hpp [Pa]
  Field pore_viscosity;    // mu_c of the fluid between the grains, of laws of viscous contacts [Pa s]
  Field viscous_stress;    // mu_c gamma of viscous_contact_pressure() [Pa]
  Field kinetic_pressure;  // with whole-stress friction: P_s^K at the Theta of the kinetic viscosity [Pa]
  Field bump_pressure;  // P_s^K / sqrt(Theta) at the Theta of the kinetic viscosity, beside bumpy walls [Pa
                        // s/m]

  explicit Rheology(const Grid& grid)
      : restitution(grid),
        kinetic_viscosity(grid),
        enduring_pressure(grid),
        dilatancy_tangent(grid),
        arrest_friction(grid),
        agitated_drag(grid),
        part_cells(grid),
        free_side(grid) {}

  // All but the kinetic viscosity, with ghosts filled but for part_cells, from a state and a strain of the
  // same level.
  void update(const Grid& grid, const Scene& scene, const closures::SolidLaw& law, const Boundary& boundary,
              const State& now, const StrainRate& strain);

  // The kinetic viscosity and, where they are asked for, kinetic pressure and that on bumps at `theta`, with
  // ghosts filled; e must be up to date.
  void update_kinetic_viscosity(const Grid& grid, const Scene& scene, const closures::SolidLaw& law,
                                const Boundary& boundary, const Field& f_s, const Field& theta);

 private:
  void update_viscous_contacts(const Grid& grid, const Scene& scene, const Boundary& boundary,
                               const State& now, const StrainRate& strain);
};

}  // namespace granvof
