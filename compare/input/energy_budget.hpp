// The energy budget of a run: what its ledger (run.json) says of the columns of its series.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "compare/input/run.hpp"

namespace granvof::compare {

// Each term of the ledger by the name of its column, [J] against time [s], 0 at the first row and signed so
// that their sum over all but parts and the residual is what is not accounted for: changes of what is stored
// and losses are positive, gains negative. Besides these `numerical`, the sum of its kind, and `open`, the
// sum of all. Empty for a run without a ledger, or without one of its columns.
std::map<std::string, Curve> energy_budget(const Run& run);

// Largest |open| over the turnover [J]; nothing without both.
std::optional<double> closure_error(const std::map<std::string, Curve>& budget,
                                    std::optional<double> turnover);

// Last value of a term over the turnover; nothing without them.
std::optional<double> share_of(const std::string& term, const std::map<std::string, Curve>& budget,
                               std::optional<double> turnover);

// The power of cell or step with which the last value of a term vanishes, from one run and another whose
// cells or steps are `refinement` > 1 times as large; nothing where one of them has not the term, or it is 0.
std::optional<double> order_of(const std::string& term, const std::map<std::string, Curve>& fine,
                               const std::map<std::string, Curve>& coarse, double refinement);

}  // namespace granvof::compare
