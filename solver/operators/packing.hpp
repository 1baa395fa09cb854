// Solid fraction f_p at which the grains of a cell touch, driven by shear (closures/shear_dilatancy.hpp).
#pragma once

#include "solver/operators/strain.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// f_p after the shear of a step of dt: by the deviator of the strain rate, gamma = 2 ||S'|| dt. Grains that
// are too dispersed to touch, f_s < f_s,min, forget: they will settle at f_s,min. In and out in [f_s,min,
// f_s,max].
void shear_packing(const Grid& grid, const Contact& contact, double dt, const Field& f_s,
                   const StrainRate& strain, Field& packing);

}  // namespace granvof
