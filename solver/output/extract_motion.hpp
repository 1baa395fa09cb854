// Speeds and energies. Speeds are those of the velocity interpolated to cell centres.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::scalar {

// Largest |u_s| where f_s >= 0.1 f_s,min [m/s]; none without such a cell. One nearly empty cell that numerics
// keep moving says nothing of the grains.
Value u_s_max(const CellFields& fields, const Scene& scene);
// Largest |u_s| where f_s >= 0.95 f_s,min [m/s]; none without a dense bed.
Value u_s_dense_max(const CellFields& fields, const Scene& scene);
// Largest |u_c| [m/s].
Value u_c_max(const CellFields& fields, const Scene& scene);
// Largest |u_c| where alpha f_c > 0.5 [m/s]; none without such a cell.
Value u_liquid_max(const CellFields& fields, const Scene& scene);

// Kinetic energy of the mean motion, sum of rho f |u|^2 / 2 dV [J]; in 2D for the depth of the tank.
Value kinetic_energy_solid(const CellFields& fields, const Scene& scene);
Value kinetic_energy_liquid(const CellFields& fields, const Scene& scene);
Value kinetic_energy_gas(const CellFields& fields, const Scene& scene);
// Potential energy above the floor, sum of rho f g y dV [J].
Value potential_energy_solid(const CellFields& fields, const Scene& scene);
Value potential_energy_liquid(const CellFields& fields, const Scene& scene);
Value potential_energy_gas(const CellFields& fields, const Scene& scene);

}  // namespace granvof::scalar
