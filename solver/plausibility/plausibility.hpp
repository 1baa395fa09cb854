// What a case says that is allowed but hardly meant: values in another unit, values that have no effect,
// scales that do not fit together.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.hpp"

namespace granvof {

struct Implausible {
  std::string key;     // "solid.friction"
  std::string given;   // its value, with its unit
  std::string usual;   // "0.05 to 1.5"
  std::string reason;  // why others are hardly meant, and what may be
};

// At most one for each key, in the order of the keys. The physics of a run needs no system of units; what is
// usual does: it is stated in SI.
std::vector<Implausible> plausibility(const Scene& scene);

// "solid.friction = 21.8: usual is 0.05 to 1.5: a tangent; degrees?"
std::string text_of(const Implausible& finding);

}  // namespace granvof
