// Solid fraction f_p at which the grains of a cell touch, driven by shear (closures/shear_dilatancy.hpp).
#pragma once

#include "solver/operators/rheology.hpp"
#include "solver/operators/strain.hpp"

namespace granvof {

// f_p after the shear of a step of dt: by the deviator of the strain rate, gamma = 2 ||S'|| dt. Grains that
// are too dispersed to touch, f_s < f_s,min, forget: they will settle at f_s,min. In and out in [f_s,min,
// f_s,max]. Where model.critical_packing depends on it, the packing it is driven to falls with the rate of
// shear under the P_s^E of the step, in the fluid between the grains.
void shear_packing(const Grid& grid, const Scene& scene, double dt, const Field& f_s,
                   const Rheology& rheology, const StrainRate& strain, Field& packing);

}  // namespace granvof
