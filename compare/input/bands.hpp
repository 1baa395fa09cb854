// How far a DEM-VOF record moves with what the continuum does not have: seed, fluid grid, depth of the slice.
// Measured by reference/bands on the scenes that were recorded more than once (the canary; seeds also of s1),
// kept in reference/results/bands.json.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace granvof::compare {

// By column ("front_dense [m]"), rms over the run in the column's unit: the largest difference of each of the
// three, taken together as the root of the sum of squares (another floor is another scene, no uncertainty).
using Bands = std::map<std::string, double, std::less<>>;

// Empty where `records` has no bands.json. Throws OutputError for a damaged file.
Bands read_bands(const std::filesystem::path& records);

}  // namespace granvof::compare
