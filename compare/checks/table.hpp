// Reads the table of checks. Its format is described at the head of compare/checks.toml.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "compare/checks/check.hpp"

namespace granvof::compare {

// Bad input; what() is one line: "<file>:<line>: <key>: what was given, what is allowed".
class TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws TableError for anything unknown, missing, doubled or out of range: metrics, formulas, parameters and
// units are checked against the registry, runs against the [[run]] entries.
Table read_table(const std::filesystem::path& file);

// The same from text; `name` stands for the file in messages.
Table parse_table(std::string_view text, std::string_view name);

}  // namespace granvof::compare
