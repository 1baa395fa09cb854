// The line with which a finished run ends: what came out, what it cost, what to worry about, what to do next.
#pragma once

#include <filesystem>
#include <string>

#include "solver/output/extract.hpp"
#include "solver/output/run_record.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// `end`: the scalars of the last row of series.csv; those that say most of the scene are shown, in SI units.
std::string closing_line(const Scene& scene, const RunProgress& progress, const Scalars& end,
                         const std::filesystem::path& directory);

}  // namespace granvof
