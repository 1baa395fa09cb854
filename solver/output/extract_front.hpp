// Run-out fronts and the shape of the deposit. All x from the wall x = 0 at which the column stands [m].
#pragma once

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::scalar {

// The paper's run-out: largest x with f_s >= 0.95 f_s,min over all rows and, in 3D, all z; linear between
// cell centres.
Value front_dense(const CellFields& fields, const Scene& scene);
// The same per z, averaged over those z that have a dense cell.
Value front_dense_mean(const CellFields& fields, const Scene& scene);
// Largest x with f_s >= 0.30.
Value front_dilute(const CellFields& fields, const Scene& scene);
// x left of which 99.5 % of the solid volume lies, linear inside the cell.
Value front_quantile(const CellFields& fields, const Scene& scene);
// Largest value of the bed height profile h(x) [m].
Value deposit_height(const CellFields& fields, const Scene& scene);
// Angle of the deposit's face towards +x [deg]: least-squares line through h(x) from the last cell at or
// above 80 % of the largest height down to 20 % of it. None where fewer than three cells lie between (a
// vertical face).
Value slope(const CellFields& fields, const Scene& scene);

}  // namespace granvof::scalar
