// Levels, fronts and volume of the liquid. alpha is the liquid share of the continuous phase, so that the
// pores of a bed count like open water.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::scalar {

// y_i: height at which alpha = 0.5 [m]. alpha of a row is the mean over the whole tank, weighted by f_c
// (liquid volume over fluid volume); the highest row at or above 0.5 counts, linear between cell centres. A
// bed that spans the tank thus has its level in the pores. None without liquid, the ceiling in a full tank.
Value interface_height(const CellFields& fields, const Scene& scene);
// The same over the columns outside the bed's initial extent only: the free surface around a bed that does
// not span the tank. None where there is no column wholly outside.
Value interface_height_outside(const CellFields& fields, const Scene& scene);
// Dam break: largest x with alpha >= 0.5 in the lowest row, all z, linear between cell centres [m].
Value liquid_front(const CellFields& fields, const Scene& scene);
// Height of the liquid in the column of cells at the left and right wall [m]: integral of alpha dy, averaged
// over z (exact inside a cell, and drops count). At the cell centre, half a cell off the wall.
Value liquid_height_left(const CellFields& fields, const Scene& scene);
Value liquid_height_right(const CellFields& fields, const Scene& scene);
// Volume of the liquid, alpha f_c, pores included [m3].
Value liquid_volume(const CellFields& fields, const Scene& scene);

}  // namespace granvof::scalar
