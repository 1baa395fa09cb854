// A box of equal cells as an OpenFOAM mesh, built in memory.
#pragma once

#include <memory>

#include "fvCFD.H"
#include "reference/demvof/fluid/fluid.hpp"

namespace demvof {

// Cell (i, j, k) gets the label (k ny + j) nx + i. Patches: left, right, bottom, top, front, back in this
// order; an `empty` front and back make the mesh two-dimensional.
std::unique_ptr<Foam::fvMesh> make_box_mesh(const FluidSettings& settings, const Foam::Time& time);

}  // namespace demvof
