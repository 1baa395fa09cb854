// Every scalar of a row of series.csv from the fields of one instant: the one code for both programs.
//
// One table (scalar_table) holds name, unit, description and function of each scalar; the header of
// series.csv, the table of docs/output.md and the rows all come from it. A function returns no value where
// the quantity is undefined (no dense bed, no liquid): an empty field, never 0 or NaN.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/output/cell_fields.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

struct ScalarEntry {
  std::string_view name;
  std::string_view unit;
  std::string_view description;
  Value (*function)(const CellFields&, const Scene&);
};

std::span<const ScalarEntry> scalar_table();

// One value per entry of scalar_table(), in its order.
using Scalars = std::vector<Value>;

// Throws std::invalid_argument if an array has a wrong size or the grid does not fill the scene's tank,
// std::domain_error naming field, cell and time for a value that is not finite.
Scalars extract_scalars(const CellFields& fields, const Scene& scene);

}  // namespace granvof
