// What a steady flow over a floor leads to at its last instant: the film of an open channel, and where a flow
// meets the floor again behind a step.
#pragma once

#include <optional>

#include "solver/output/cell_fields.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

// Depth of the liquid [m] in the middle of the tank along x: alpha summed up from the floor.
double liquid_depth_in_the_middle(const CellFields& fields);

// u(y) = g_x rho / mu (h y - y^2 / 2) [m/s] of a film of that depth [m], y from the floor (Nusselt 1916).
double speed_in_film(const Scene& scene, double depth, double y);

// Largest distance of u_c along x in the middle of the tank from a film of the depth there, in cells that are
// liquid, as those above them are, over its largest
// [-]. Nothing without such cells.
std::optional<double> film_distance(const CellFields& fields, const Scene& scene);

// Length over which the flow behind the first obstacle goes back along the floor, over its height [-]: to
// where u_c of the lowest cells turns, between two of their centres. Nothing without an obstacle on the
// floor, or where the flow does not go back.
std::optional<double> reattachment_length(const CellFields& fields, const Scene& scene);

}  // namespace granvof::compare
