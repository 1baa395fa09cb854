// The energy budget of a run, from the columns energy_*, lost_* and gained_* of its series.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "compare/input/run.hpp"

namespace granvof::compare {

// By name, each [J] against time [s] and 0 at the first row: `kinetic`, `potential`, `granular`, `elastic`
// (changes of what is stored), `drag`, `friction`, `viscosity`, `collisions`, `outside` (losses; outside:
// outflow less the work of moving walls), `dilatancy` (the loss by the work of P_s^EF), the five
// `numerical_*` and `numerical`, their sum, and `open`, what is left of the sum of all: the residual.
// Empty for a series without these columns.
std::map<std::string, Curve> energy_budget(const Run& run);

// Largest |open| over the turnover [J]; nothing without both.
std::optional<double> closure_error(const std::map<std::string, Curve>& budget,
                                    std::optional<double> turnover);

// Last `numerical` over the turnover.
std::optional<double> numerical_share(const std::map<std::string, Curve>& budget,
                                      std::optional<double> turnover);

}  // namespace granvof::compare
