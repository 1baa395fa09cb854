// Curves and shapes that take a run's scene as well as its series; the table's metrics and the plots share
// them.
#pragma once

#include <optional>

#include "compare/input/run.hpp"
#include "compare/metrics/deposit_shape.hpp"
#include "compare/metrics/run_out.hpp"

namespace granvof::compare {

// h0 and g of a scene with a bed.
ColumnSize column_of(const Scene& scene);

// Run-out (l - l0) / h0 [-] against T [-]; empty for a scene without a bed.
Curve run_out_curve(const Run& run);

// Pressure at the base less its value in the same tank at rest [Pa] against t [s].
Curve excess_base_pressure(const Run& run);

// Hydrostatic pressure where p_base is taken, at the centres of the lowest cells, P = 0 at the open top [Pa].
double base_pressure_at_rest(const Scene& scene);

// The deposit at T; nothing if the run wrote no fields then, or the scene has no bed.
std::optional<DepositShape> deposit_at(const Run& run, double scaled_time);

}  // namespace granvof::compare
