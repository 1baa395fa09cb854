// Recorded DEM-VOF runs, reference/results/<scene>/<variant>/ (series.csv, fields.h5, record.json).
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "compare/input/run.hpp"

namespace granvof::compare {

// All variants of one recorded scene, in the order of their names; empty if there are none. A variant is
// stale if its case hash is not `scene.reference_hash`, refused if it is damaged or holds a value that is not
// finite.
std::vector<LoadedRun> load_records(const std::filesystem::path& records, std::string_view name,
                                    const Scene& scene);

}  // namespace granvof::compare
