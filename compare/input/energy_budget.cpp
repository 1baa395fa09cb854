#include "compare/input/energy_budget.hpp"

#include <algorithm>
#include <cmath>

namespace granvof::compare {
namespace {

void accumulate(Curve& sum, const Curve& curve, double sign) {
  if (sum.empty()) sum = {curve.time, std::vector<double>(curve.time.size(), 0.0)};
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    sum.value[i] += sign * (curve.value[i] - curve.value.front());
}

}  // namespace

std::map<std::string, Curve> energy_budget(const Run& run) {
  std::map<std::string, Curve> budget;
  for (const LedgerTerm& term : run.facts.ledger) {
    const Curve curve = run.curve(term.name);
    if (curve.empty()) return {};
    const bool counts = term.kind != "part" && term.kind != "residual";
    accumulate(budget[term.name], curve, counts ? term.sign : 1.0);
    if (counts) accumulate(budget["open"], curve, term.sign);
    if (term.kind == "numerical") accumulate(budget["numerical"], curve, term.sign);
  }
  return budget;
}

std::optional<double> closure_error(const std::map<std::string, Curve>& budget,
                                    std::optional<double> turnover) {
  if (budget.empty() || !turnover || *turnover <= 0.0) return std::nullopt;
  double largest = 0.0;
  for (const double value : budget.at("open").value) largest = std::max(largest, std::abs(value));
  return largest / *turnover;
}

std::optional<double> share_of(const std::string& term, const std::map<std::string, Curve>& budget,
                               std::optional<double> turnover) {
  const auto found = budget.find(term);
  if (found == budget.end() || !turnover || *turnover <= 0.0) return std::nullopt;
  return found->second.value.back() / *turnover;
}

std::optional<double> order_of(const std::string& term, const std::map<std::string, Curve>& fine,
                               const std::map<std::string, Curve>& coarse, double refinement) {
  const auto of_fine = fine.find(term), of_coarse = coarse.find(term);
  if (of_fine == fine.end() || of_coarse == coarse.end() || !(refinement > 1.0)) return std::nullopt;
  const double ratio = of_coarse->second.value.back() / of_fine->second.value.back();
  if (!std::isfinite(ratio) || ratio == 0.0) return std::nullopt;
  return std::log(std::abs(ratio)) / std::log(refinement);
}

}  // namespace granvof::compare
