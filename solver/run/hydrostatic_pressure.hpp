// The fluid's pressure at the start: the one at which its discrete momentum balance is at rest.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/state/state.hpp"

namespace granvof {

// Of the fluid in a cell [kg/m3].
inline double fluid_density(const Scene& scene, const State& s, std::ptrdiff_t cell) {
  return mixture(s.alpha[cell], scene.liquid.density, scene.gas.density);
}

// Sets p_c [Pa] of a state whose fractions are set, ghosts included: hydrostatic from the top down, with the
// continuous phase alone, for grains at rest hang on P_s. Columns below an obstacle begin at what is beside
// them. Each part of the fluid that is sealed has its own level (pressure_level.hpp).
void set_hydrostatic_pressure(const Grid& grid, const Scene& scene, const Boundary& boundary, State& s);

}  // namespace granvof
