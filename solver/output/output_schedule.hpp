// What a step brings due: the rows and fields whose times it passes.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"

namespace granvof {

struct DueOutput {
  double time = 0.0;  // [s]
  bool row = false, fields = false;
};

// All output asked for with after < time <= until [s], ascending.
std::vector<DueOutput> due_output(const Times& times, double after, double until);

}  // namespace granvof
