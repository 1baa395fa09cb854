// Recorded runs of the reference and of stock OpenFOAM programs, each with series.csv, fields.h5 and
// record.json: reference/results/<scene>/<variant>/ and reference/results/peers/<program>/<scene>/.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "compare/input/run.hpp"

namespace granvof::compare {

// All variants of one recorded scene, in the order of their names; itself, where it is a record without
// variants; empty if there are none. A variant is stale if its case hash is not `scene.reference_hash`,
// refused if it is damaged or holds a value that is not finite.
std::vector<LoadedRun> load_records(const std::filesystem::path& records, std::string_view name,
                                    const Scene& scene);

// What stock programs made of a case, in the order of their names; the run's id is the program's name.
std::vector<LoadedRun> load_peers(const std::filesystem::path& records, std::string_view case_name,
                                  const Scene& scene);

}  // namespace granvof::compare
