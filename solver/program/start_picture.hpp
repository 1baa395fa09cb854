// The start of a scene as a picture, to see what a case says before it is run.
#pragma once

#include <string>

#include "solver/scene/scene.hpp"

namespace granvof {

// SVG of the plane x, y: tank, liquid, bed (of a case with a slope its face), gate, the grid's lines and what
// each side is, with their sizes in mm. Of a 3D scene the view from the front, which is what it looks like at
// every z.
std::string picture_of_start(const Scene& scene);

}  // namespace granvof
