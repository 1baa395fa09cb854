// A box of equal cells, less those that obstacles fill, as an OpenFOAM mesh, built in memory.
#pragma once

#include <memory>

#include "fvCFD.H"
#include "reference/demvof/fluid/fluid.hpp"

namespace demvof {

// Where in the tank each cell of the mesh lies: (k ny + j) nx + i, ascending. Without obstacles its own
// label.
Foam::labelList places_of_cells(const FluidSettings& settings);

// Patches: left, right, bottom, top, front, back in this order, then the obstacles' faces if there are any;
// an `empty` front and back make the mesh two-dimensional.
std::unique_ptr<Foam::fvMesh> make_box_mesh(const FluidSettings& settings, const Foam::Time& time);

}  // namespace demvof
