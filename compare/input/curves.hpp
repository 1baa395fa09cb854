// Curves and shapes that take a run's scene as well as its series; the table's metrics and the plots share
// them.
#pragma once

#include <optional>
#include <string>

#include "compare/input/run.hpp"
#include "compare/metrics/deposit_shape.hpp"
#include "compare/metrics/run_out.hpp"

namespace granvof::compare {

// h0 and g of a run whose scene has a bed: h0 is the scene's, or what a recorded column of beads really had
// when it was released.
ColumnSize column_of(const Run& run);

// Run-out (l - l0) / h0 [-] against T [-], by the three fronts of run_out.hpp; empty for a scene without a
// bed or a series without that front.
Curve run_out_curve(const Run& run);
Curve run_out_dense_curve(const Run& run);
Curve run_out_quantile_curve(const Run& run);

// The dense front [m] against t [s], up to where it meets the far end of the tank.
Curve free_front(const Run& run);

// Pressure at the base less its value in the same tank at rest [Pa] against t [s].
Curve excess_base_pressure(const Run& run);

// Hydrostatic pressure where p_base is taken, at the centres of the lowest open cells, P = 0 at the open top
// [Pa].
double base_pressure_at_rest(const Scene& scene);

// The deposit at T; nothing if the run wrote no fields then, or the scene has no bed.
std::optional<DepositShape> deposit_at(const Run& run, double scaled_time);

// Front of a water column, x / a against tau (Martin & Moyce), a the length of the first box of liquid; their
// tau starts 0.175 before the motion.
Curve scaled_liquid_front(const Run& run);

// Height of a level of f_s [m] against t [s], from the run's fields.
Curve solid_level_curve(const Run& run, double level);

// A series of cases/published, found beside the run's case file. Throws OutputError.
Curve published_curve(const Run& run, const std::string& file, const std::string& column);

}  // namespace granvof::compare
