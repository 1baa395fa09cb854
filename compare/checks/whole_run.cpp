#include "compare/checks/whole_run.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "compare/input/energy_budget.hpp"
#include "compare/metrics/conservation.hpp"

namespace granvof::compare {
namespace {

// The solver's own account covers every step, the series only the output times: the worse of the two counts.
// Where something flows through the tank the account alone knows what has passed its sides.
Measured volume_error_of(const Run& run, std::string_view column, std::string_view fact) {
  const auto counted = run.facts.number(fact);
  const bool through = std::ranges::any_of(run.scene.sides, [](const Side& side) {
    return side.kind == SideKind::inlet || side.kind == SideKind::outlet;
  });
  const auto sampled = through ? std::optional(0.0) : volume_error(run.curve(column));
  if (!sampled || !counted) return {std::nullopt, "undefined: no volume in the series or in run.json"};
  return {std::max(*sampled, std::abs(*counted)), ""};
}

// How much smaller the cells of a run are than another's or, where they are the same, how many more steps it
// took.
double refinement_from(const Run& coarse, const Run& fine) {
  const double of_cells = coarse.scene.grid.spacing[0] / fine.scene.grid.spacing[0];
  if (of_cells != 1.0) return of_cells;
  return fine.facts.number("steps").value_or(0.0) / coarse.facts.number("steps").value_or(1.0);
}

}  // namespace

Measured solid_volume_error(const Run& run, const Parameters&, const FindRun&) {
  return volume_error_of(run, "solid_volume", "solid_volume_error");
}

Measured liquid_volume_error(const Run& run, const Parameters&, const FindRun&) {
  return volume_error_of(run, "liquid_volume", "liquid_volume_error");
}

Measured solid_fraction_max(const Run& run, const Parameters&, const FindRun&) {
  const auto sampled = maximum(run.curve("f_s_max"));
  const auto counted = run.facts.number("solid_fraction_max");
  if (!sampled || !counted)
    return {std::nullopt, "undefined: no solid fraction in the series or in run.json"};
  return {std::max(*sampled, *counted), ""};
}

Measured solid_fraction_min(const Run& run, const Parameters&, const FindRun&) {
  return measured(minimum(run.curve("f_s_min")), "no solid fraction in the series");
}

Measured liquid_speed_max(const Run& run, const Parameters& p, const FindRun&) {
  return measured(maximum(clip(run.curve("u_liquid_max"), *p.window)), "no speed in the window");
}

Measured fluid_speed_max(const Run& run, const Parameters& p, const FindRun&) {
  return measured(maximum(clip(run.curve("u_c_max"), *p.window)), "no speed in the window");
}

Measured solid_speed_max(const Run& run, const Parameters& p, const FindRun&) {
  return measured(maximum(clip(run.curve("u_s_dense_max"), *p.window)), "no dense bed in the window");
}

Measured energy_closure(const Run& run, const Parameters&, const FindRun&) {
  return measured(closure_error(energy_budget(run), run.facts.number("energy_turnover")),
                  "no energy budget in the series or in run.json");
}

Measured ledger_share(const Run& run, const Parameters& p, const FindRun&) {
  return measured(share_of(*p.scheme, energy_budget(run), run.facts.number("energy_turnover")),
                  "no such term in the ledger of run.json, or no series of it");
}

Measured ledger_order(const Run& run, const Parameters& p, const FindRun& find) {
  const Run* coarse = find(*p.against);
  if (!coarse) return {std::nullopt, fmt::format("the run '{}' cannot be compared", *p.against)};
  return measured(
      order_of(*p.scheme, energy_budget(run), energy_budget(*coarse), refinement_from(*coarse, run)),
      "no such term in both ledgers, or neither cells nor steps are smaller");
}

Measured energy_created(const Run& run, const Parameters&, const FindRun&) {
  return measured(run.facts.number("energy_created"), "run.json states no created energy");
}

Measured warnings(const Run& run, const Parameters&, const FindRun&) {
  return measured(run.facts.number("warnings"), "run.json states no warnings");
}

Measured core_seconds(const Run& run, const Parameters&, const FindRun&) {
  return measured(run.facts.number("core_seconds"), "run.json states no cost");
}

}  // namespace granvof::compare
