// Reference values that are computed from a scene's own parameters, never typed.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "compare/checks/check.hpp"
#include "compare/input/run.hpp"

namespace granvof::compare {

struct FormulaEntry {
  std::string_view name;
  std::string_view unit;
  std::string_view text;  // the formula and its source, for reports
  // Nothing where the scene or run lacks what the formula needs (no bed, no window).
  std::optional<double> (*function)(const Run&, const Parameters&);
};

std::span<const FormulaEntry> formulas();
const FormulaEntry* find_formula(std::string_view name);

}  // namespace granvof::compare
