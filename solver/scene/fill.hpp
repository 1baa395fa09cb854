// Which share of a cell the bed and the liquid of a scene cover at the start, and the colour of the bed's
// part; exact, partial cells included.
#pragma once

#include <span>

#include "solver/scene/scene.hpp"

namespace granvof {

// These return a share of the cell's volume, in [0, 1]; `cell` has a positive size in every direction.
double share_of(const Box& box, const Box& cell);
double share_of(const Bed& bed, const Box& cell);              // the sloped front face counts
double share_of(std::span<const Box> boxes, const Box& cell);  // of their union: what two cover counts once

// Of the bed and the liquid both.
double shared_by(const Bed& bed, std::span<const Box> boxes, const Box& cell);

// Mean colour phi in [0, 1] of the bed's box within the cell; 0 where they have nothing in common.
double colour_of(const Bed& bed, const Box& cell);

}  // namespace granvof
