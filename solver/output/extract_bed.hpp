// The bed: its centre, extent and load on the floor, and the amount of solid.
//
// Immersion depth of a floating bed: h = H/2 + (y_i - y_c), with y upward. (The paper prints H/2 + (y_c -
// y_i), which would make a bed that sinks deeper less immersed.) It is formed from the averages of these
// columns, not here.
// Equations: docs/theory/metrics.md.
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::scalar {

// Mean of P_c in the lowest cells under the bed's initial base, at their centres (not extrapolated to the
// floor) [Pa]. On obstacles that stand on the floor they are those above them.
Value p_base(const CellFields& fields, const Scene& scene);
// Mean height of those centres [m]; of the fields only the grid is read.
Value base_height(const CellFields& grid, const Scene& scene);
// Eq (27): mean height of the cells with f_s > 0.95 f_s,min, weighted by f_s [m]. None until a cell is that
// dense.
Value y_c(const CellFields& fields, const Scene& scene);
// Lower edge of the dense bed [m], in the profile of f_s over the bed's original columns: rows with f_s >=
// 0.95 f_s,min are the bed, and its outermost rows count by their share of what lies behind and before them.
// Exact for a sharp edge, wherever it cuts a cell; 0 if the lowest row is dense; none without a dense row.
Value bed_bottom(const CellFields& fields, const Scene& scene);
// Upper edge, likewise [m]; the ceiling if the highest row is dense.
Value bed_top(const CellFields& fields, const Scene& scene);
// H = bed_top - bed_bottom [m].
Value bed_height(const CellFields& fields, const Scene& scene);
// Height the profile would have if all of it were as dense as its dense rows on average [m]: grains that have
// left the dense rows count. None without a dense row.
Value bed_height_equivalent(const CellFields& fields, const Scene& scene);
// Centre of mass of all solid [m].
Value y_solid_mean(const CellFields& fields, const Scene& scene);
// Volume of all solid [m3].
Value solid_volume(const CellFields& fields, const Scene& scene);
// Largest and smallest f_s of any cell [-].
Value f_s_max(const CellFields& fields, const Scene& scene);
Value f_s_min(const CellFields& fields, const Scene& scene);
// Largest granular temperature where f_s >= 0.1 f_s,min [m2/s2]; none without such a cell.
Value theta_max(const CellFields& fields, const Scene& scene);

}  // namespace granvof::scalar
