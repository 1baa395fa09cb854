// The uncertainty of what is read from a DEM-VOF record, by the name of the metric or curve.
#pragma once

#include <optional>
#include <string_view>

#include "compare/input/bands.hpp"
#include "compare/input/run.hpp"

namespace granvof::compare {

// In the unit of `quantity` ("run_out", "grain_front", "solid_height"): what `bands` say of the column of
// series.csv that it is a value of, scaled as the quantity is. Nothing for a quantity that is no value of one
// column (a rate, a share, a sign), or that they know nothing of.
std::optional<double> record_uncertainty(std::string_view quantity, const Run& record, const Bands& bands);

}  // namespace granvof::compare
