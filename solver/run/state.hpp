// Everything that is carried from one time step to the next.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/run/energy_terms.hpp"

namespace granvof {

struct State {
  double time = 0.0;   // [s]; negative while the column is held before its release
  Field f_s;           // solid fraction [-]
  Field alpha;         // liquid share of the continuous phase [-]
  Field p_c, p_s;      // fluid and solid pressure [Pa]
  Field theta;         // granular temperature [m2/s2]
  Field phi;           // colour of the solid [-]
  Field packing;       // solid fraction at which the grains touch: f_s,min but with shear dilatancy [-]
  FaceField u_s, u_c;  // velocities on faces [m/s]
  FaceField u_strain;  // u_s after the friction step: the velocity whose strain sets the next friction [m/s]
  EnergyTerms energy;  // stored now, and where it went since the start [J]

  explicit State(const Grid& grid);
  void fill_ghosts(const Boundary& boundary);
};

// The state at the start of a scene: the bed and the liquid by volume share of each cell, both at rest, fluid
// pressure hydrostatic, no solid pressure: the packing takes the bed's weight in the first steps. Where the
// model carries the packing, the bed bears it from the start.
State initial_state(const Grid& grid, const Scene& scene, const Boundary& boundary);

}  // namespace granvof
