// What face fluxes do to the content of cells: the finite-volume sums that every transport equation shares.
//
// A flux is a volume per area and time [m/s] on the faces of each direction, positive upwards in the index.
#pragma once

#include "solver/grid/field.hpp"

namespace granvof {

// content -= dt div(flux), of all cells or those given. Conservative to rounding.
void subtract_divergence(const Grid& grid, double dt, const FaceField& flux, const Range& cells,
                         Field& content);
void subtract_divergence(const Grid& grid, double dt, const FaceField& flux, Field& content);

// content -= dt div(flux value), value taken from the cell the flux leaves; one ghost layer of value must be
// filled.
void subtract_upwind_divergence(const Grid& grid, double dt, const FaceField& flux, const Field& value,
                                const Range& cells, Field& content);
void subtract_upwind_divergence(const Grid& grid, double dt, const FaceField& flux, const Field& value,
                                Field& content);

// rate = volume that leaves a cell through its faces per volume and time [1/s].
void outflow_rate(const Grid& grid, const FaceField& flux, Field& rate);

}  // namespace granvof
