// Published series, cases/published/*.tsv: '#' comments, a header "name [unit]", tab-separated numbers.
#pragma once

#include <filesystem>
#include <string_view>

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// The column `name` against the file's first column. Throws OutputError naming file, line and what is wrong:
// no such column, another number of fields, something that is not a finite number, an abscissa that does not
// ascend.
Curve read_published(const std::filesystem::path& file, std::string_view name);

}  // namespace granvof::compare
