// A case in other units of mass, length and time: the same dimensionless problem.
#pragma once

#include <string>

#include "solver/scene/scene.hpp"
#include "solver/scene/units.hpp"

namespace granvof {

// The resolved case with every dimensional number multiplied by its unit's factor, as the table of keys
// states the units; times in units of the bed's column stay. A run of it takes the same steps. Throws
// CaseError where a value leaves its key's range (by underflow or overflow alone).
std::string restated_case(const Scene& scene, const UnitFactors& factors);

}  // namespace granvof
