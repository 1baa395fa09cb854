// How far two runs are apart that must be the same run but for something that may not matter: their rows,
// their depth, the units they are stated in.
#pragma once

#include <optional>
#include <string>

#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

struct SeriesDifference {
  double largest = 0.0;  // [-]
  std::string column;    // where that is; empty where nothing differs
  double time = 0.0;     // of the row, in the first scene's unit of time
};

// Largest difference of any column of two series.csv, each number divided by its own scene's scale of that
// unit (solver/scene/scales.hpp; volumes by the tank's, angles by a radian): so neither units nor, for
// volumes and energies, the tank's depth counts. The rows compared are those of the series that has fewer.
// Left out is what counts the solvers' work. Infinite where a value is defined in one run alone; nothing
// where that series has no row, the columns are not the same, or the other series lacks one of its times
// (1e-9 of its end). Throws std::out_of_range for a column of an unknown unit.
std::optional<SeriesDifference> series_difference(const Series& a, const Scene& scene_a, const Series& b,
                                                  const Scene& scene_b);

}  // namespace granvof::compare
