// What the fluid's pressure in a tank is held against: that of rest, and what a bed takes from a flow.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

// Largest distance of P_c from rho_l g (x - x_0), x_0 the middle of the lid, over the largest of that
// pressure [-]: of a tank full of liquid, level or inclined.
double hydrostatic_distance(const CellFields& fields, const Scene& scene);

// Fall of P_c from the lowest row to the highest dense one (f_s >= 0.95 f_s,min) less the weight of the
// liquid between, over what Ergun (1952) has for the packing there at the speed of the inlet in the floor
// [-]; 0 without two dense rows:
//   dP/dy = 150 f^2 mu U / ((1-f)^3 d^2) + 1.75 f rho U^2 / ((1-f)^3 d), U superficial.
// Of a tank full of liquid; above 0.2 it is (8) and (9).
double ergun_ratio(const CellFields& fields, const Scene& scene);

}  // namespace granvof::compare
