// Obstacles of a scene on demvof's grid, for beads and fluid.
#pragma once

#include <string>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

// `gridded`: the scene with demvof's grid, its faces on the grid's.
Obstacles obstacles_on(const granvof::Scene& gridded);

// Why beads and fluid cannot have them, in a sentence; empty where they can. They lie on faces of the fluid
// cells, share faces with each other or stand apart, and shut no part of the tank off.
std::string obstacles_refused(const granvof::Scene& gridded);

// Whether the point is inside an obstacle; on its upper faces it is not.
bool inside_an_obstacle(const granvof::Scene& scene, const double* point);

}  // namespace demvof
