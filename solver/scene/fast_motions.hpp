// How fast what a scene holds may come to move: falls, collapses, slides, and what walls, inlets and outlets
// drive. From lengths and gravity alone, to a factor of two or so.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"

namespace granvof {

// Speed of one motion over time: it grows from rest, stays, and what is left of it goes on.
struct Motion {
  double acceleration = 0.0;  // until `grown` [m/s2]
  double grown = 0.0;         // [s]
  double speed = 0.0;         // from then on until `lasts` [m/s]
  double lasts = 0.0;         // [s]
  double late = 0.0;          // after that [m/s]

  double at(double time) const;
};

// None where nothing will move faster than grains settle: layers at rest.
std::vector<Motion> fast_motions(const Scene& scene);

}  // namespace granvof
