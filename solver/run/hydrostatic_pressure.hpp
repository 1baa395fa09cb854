// The fluid's pressure at the start: the one at which its discrete momentum balance is at rest.
#pragma once

#include "solver/operators/mixture.hpp"
#include "solver/state/state.hpp"

namespace granvof {

// Of the fluid in a cell [kg/m3].
inline double fluid_density(const Scene& scene, const State& s, std::ptrdiff_t cell) {
  return mixture(s.alpha[cell], scene.liquid.density, scene.gas.density);
}

// What the density that the fluid of a face moves, its f_c rho_c over its f_c by FaceInertia, lacks of the
// mean density of its two cells [kg/m3]: the denser fluid counts less where grains leave it less room.
inline double density_lack(double f_s_a, double rho_a, double f_s_b, double rho_b) {
  return 0.25 * (f_s_b - f_s_a) * (rho_b - rho_a) / (1.0 - 0.5 * (f_s_a + f_s_b));
}

// Sets p_c [Pa] of a state whose fractions are set, ghosts included: hydrostatic from the top down, with the
// continuous phase alone, for grains at rest hang on P_s. Columns below an obstacle begin at what is beside
// them. Each part of the fluid that is sealed has its own level (pressure_level.hpp).
//
// What P_c has of the faces' lack beside the pressure by mean densities is returned [Pa], for the grains to
// bear the rest; an empty field where it is none.
Field set_hydrostatic_pressure(const Grid& grid, const Scene& scene, State& s);

}  // namespace granvof
