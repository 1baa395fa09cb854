// The uncertainty of what is read from a DEM-VOF record, by the name of the metric or curve.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "compare/input/run.hpp"

namespace granvof::compare {

// In the unit of `quantity` ("run_out", "grain_front", "solid_height"): what bands.json of `records` says of
// the column of series.csv that it is a value of (input/bands.hpp), scaled as the quantity is. Nothing for a
// quantity that is no value of one column (a rate, a share, a sign), or that bands.json knows nothing of.
std::optional<double> record_uncertainty(std::string_view quantity, const Run& record,
                                         const std::filesystem::path& records);

}  // namespace granvof::compare
