// The components of a face field as the linear solvers take them.
#pragma once

#include "solver/grid/field.hpp"
#include "solver/linear/conjugate_gradient.hpp"

namespace granvof {

inline linear::Components component_pointers(FaceField& f, int dim) {
  linear::Components p{};
  for (int d = 0; d < dim; ++d) p[d] = f[d].data();
  return p;
}

}  // namespace granvof
