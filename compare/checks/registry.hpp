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

// With the note "undefined: ..." where there is no value.
Measured measured(std::optional<double> value, std::string_view why_undefined);

// Finds another run by its id, or nullptr.
using FindRun = std::function<const Run*(std::string_view)>;

struct MetricEntry {
  std::string_view name;
  std::string_view unit;  // "-" for none
  std::string_view description;
  Needs needs;
  Measured (*function)(const Run&, const Parameters&, const FindRun&);
  bool of_cost = false;  // a run that it is measured of must go alone
  Curve (*curve)(const Run&) =
      nullptr;  // of a metric that is judged by its distance from a record's (whole_curve.hpp)
};

std::span<const MetricEntry> metrics();
const MetricEntry* find_metric(std::string_view name);

}  // namespace granvof::compare
