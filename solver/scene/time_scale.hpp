// The time in which a scene changes, from what stands in its case.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// [s]: sqrt(h/g), in which the bed (without one: the liquid, without liquid: the tank) falls by half its
// height h. Infinite without gravity.
double fall_time(const Scene& scene);

// [s]: fall_time; or, where that takes longer, the time in which a grain settles or rises by a cell in the
// liquid (Stokes), which is how fast a suspension changes.
double time_scale(const Scene& scene);

}  // namespace granvof
