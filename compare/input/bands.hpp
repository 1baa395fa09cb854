// How far a DEM-VOF record moves with what the continuum does not have: seed, fluid grid, depth of the slice.
// Measured on the canary by reference/bands, kept in reference/results/bands.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace granvof::compare {

// Of `column` ("front_dense [m]"), rms over the run in the column's unit: the largest difference of each of
// the three, taken together as the root of the sum of squares (another floor is another scene, no
// uncertainty). Nothing where `records` has no bands.json, or that no such column. Throws OutputError for a
// damaged file.
std::optional<double> band_of(const std::filesystem::path& records, std::string_view column);

}  // namespace granvof::compare
