// Profiles and helpers that the scalars of extract.hpp are made of; also used to draw deposits and levels.
//
// "Dense" means f_s >= 0.95 f_s,min. Every x is measured from the wall x = 0, every y from the floor.
// All functions expect fields that check_fields() accepts.
#pragma once

#include <optional>
#include <vector>

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Throws as extract_scalars() does.
void check_fields(const CellFields& fields, const Scene& scene);

// 0.95 f_s,min, the edge of a dense bed [-].
double dense_threshold(const Scene& scene);

// A tenth of f_s,min: a cell that holds less has no bed in it but what numerics spread there, of less than a
// grain in most of our cells, and its velocity and temperature mean nothing [-].
double present_threshold(const Scene& scene);

// Which cells obstacles fill; empty where the scene has none.
std::vector<bool> obstacle_cells(const CellFields& fields, const Scene& scene);

// Volume of a cell [m3]. In 2D all layers of cells together (one in the solver, a slice of several in the
// reference) stand for the tank's depth, so that volumes and energies of both programs compare.
double cell_volume(const CellFields& fields, const Scene& scene);

// Solid volume of each column of cells x = const [m3].
std::vector<double> solid_volume_along_x(const CellFields& fields, const Scene& scene);

// Bed height profile h(x) = integral of f_s dy / f_s,min, averaged over z [m]: the height the grains would
// have at random loose packing. One value per cell along x.
std::vector<double> bed_height_profile(const CellFields& fields, const Scene& scene);

// f_s of each row of cells y = const, averaged over the columns where the bed stood at the start (cells that
// are partly under it count by their share); empty if the scene has no bed.
std::vector<double> bed_profile_along_y(const CellFields& fields, const Scene& scene);

// Share of each cell along direction 0 or 2 that lies in the bed's initial extent [-]; all 0 without a bed.
std::vector<double> share_under_bed(const CellFields& fields, const Scene& scene, int direction);

// Largest position, from cell centres (c + 1/2) h, at which the polyline through `values` is >= threshold;
// the far end n h if the last value is; none if no value is.
Value last_crossing(const std::vector<double>& values, double spacing, double threshold);

// Index of a cell in the arrays of CellFields.
inline std::size_t cell_index(const CellFields& fields, int i, int j, int k) {
  const auto nx = static_cast<std::size_t>(fields.cells[0]);
  const auto ny = static_cast<std::size_t>(fields.cells[1]);
  return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx + static_cast<std::size_t>(i);
}

}  // namespace granvof
