// g0 at contact that model.radial_distribution chooses from. The first is the paper's. Each has
//   value(f_s, RadialParameters), slope(f_s, RadialParameters) -> [-].
#pragma once

#include "solver/closures/radial_distribution/jamming.hpp"
#include "solver/closures/radial_distribution/paper.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct RadialDistributions : Choices<RadialPaper, RadialJamming> {};

}  // namespace granvof::closures
