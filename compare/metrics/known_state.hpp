// What the grains' pressure and slip of one instant are held against: even states, and the weight that a bed
// bears.
#pragma once

#include <optional>

#include "solver/output/cell_fields.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

// Mean P_s [Pa] of all cells with grains; nothing without any, or where a program writes no P_s.
std::optional<double> mean_solid_pressure(const CellFields& fields);

// u_c - u_s [m/s] along y in the middle row, mean over its cells; nothing without grains there.
std::optional<double> slip_in_the_middle(const CellFields& fields);

// Largest distance of P_s from the weight, less buoyancy, of the grains above and half those of the cell
// itself, over the largest such weight [-]: of a level bed of heavy grains at rest. Of cells that are full
// (f_s >= 0.95 f_s,min) below full ones: what the bed's surface bears is the scheme's. Nothing without two
// full rows.
std::optional<double> weight_distance(const CellFields& fields, const Scene& scene);

// Largest difference of f_s or alpha between a cell and its mirror image about the tank's middle in x [-].
double mirror_distance(const CellFields& fields);

}  // namespace granvof::compare
