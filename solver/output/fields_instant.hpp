// One instant of fields.h5: how cell fields lie in a group of HDF5.
#pragma once

#include <hdf5.h>

#include "solver/output/cell_fields.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Writes an instant into an empty group: fields as float32, u_s and u_c with three components each, and the
// centres of the cells (spacing [m]), described. Throws std::runtime_error with HDF5's message.
void write_instant(hid_t group, const CellFields& fields, const Vec3& spacing);
// Attributes of an instant whose datasets are there and have none: its time [s], units and meaning of each,
// and which axis each dimension is (HDF5 dimension scales, as netCDF has them). Throws likewise.
void describe_instant(hid_t group, double time);

// What a group holds, the grid from the attributes of `file`. Throws std::runtime_error, also where arrays
// have not the size of the grid.
CellFields read_instant(hid_t file, hid_t group);
// Time, grid and solid fraction alone. Throws likewise.
CellFields read_solid_fraction_of(hid_t file, hid_t group);

}  // namespace granvof
