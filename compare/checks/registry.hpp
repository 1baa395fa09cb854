// Every metric by name: what it takes, its unit, and how it reads a run.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compare/checks/check.hpp"
#include "compare/input/run.hpp"

namespace granvof::compare {

struct Measured {
  std::optional<double> value;  // nothing: undefined, `note` says why
  std::string note;
};

// Finds another run by its id, or nullptr.
using FindRun = std::function<const Run*(std::string_view)>;

// Which of the parameters a metric needs; what is not needed is not allowed.
struct Needs {
  bool window = false;
  bool at = false;
  bool quiet = false;
  bool level = false;
  bool published = false;  // file and column
  bool column = false;     // of series.csv
  bool against = false;
};

struct MetricEntry {
  std::string_view name;
  std::string_view unit;  // "-" for none
  std::string_view description;
  Needs needs;
  Measured (*function)(const Run&, const Parameters&, const FindRun&);
};

std::span<const MetricEntry> metrics();
const MetricEntry* find_metric(std::string_view name);

}  // namespace granvof::compare
