// Reads the table of checks. Its format is described at the head of compare/checks.toml.
#pragma once

#include <filesystem>
#include <string_view>

#include "compare/checks/check.hpp"
#include "compare/input/table_error.hpp"

namespace granvof::compare {

// Throws TableError for anything unknown, missing, doubled or out of range: metrics, formulas, parameters and
// units are checked against the registry, runs against the [[run]] entries.
Table read_table(const std::filesystem::path& file);

// The same from text; `name` stands for the file in messages.
Table parse_table(std::string_view text, std::string_view name);

}  // namespace granvof::compare
