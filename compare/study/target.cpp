#include "compare/study/target.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "compare/checks/theory.hpp"
#include "compare/input/curves.hpp"
#include "compare/input/records.hpp"

namespace granvof::compare {
namespace {

// What a record cost, the preparation of its beads included, which its core_seconds hold [core-s per
// simulated s].
std::optional<double> cost_of_record(const Run& record) {
  const auto spent = record.facts.number("core_seconds");
  const auto time = record.series.column("time");
  const double simulated = time.empty() ? 0.0 : time.back().value_or(0.0);  // stock programs do not state it
  if (!spent || simulated <= 0.0) return std::nullopt;
  return *spent / simulated;
}

Observed mean_of(const Quantity& quantity, const std::vector<Observed>& variants) {
  Observed mean;
  if (quantity.is_curve) {
    std::vector<Curve> curves;
    curves.reserve(variants.size());
    for (const Observed& variant : variants) curves.push_back(variant.curve);
    mean.curve = mean_curve(curves);
    return mean;
  }
  double sum = 0.0;
  for (const Observed& variant : variants) sum += *variant.value;
  mean.value = sum / static_cast<double>(variants.size());
  return mean;
}

}  // namespace

Target dem_target(const Quantity& quantity, const Scene& scene, const std::filesystem::path& records,
                  const std::string& name) {
  Target target{"DEM", fmt::format("reference/results/{}", name), {}, 0.0, std::nullopt, ""};
  std::vector<Observed> variants;
  double dearest = 0.0;
  const Bands bands = read_bands(records);
  for (const LoadedRun& loaded : load_records(records, name, scene)) {
    if (loaded.state == RunState::refused) throw std::runtime_error(loaded.reason);
    if (!loaded.run) {
      target.note = loaded.reason;
      continue;
    }
    Observed observed = observe(quantity, *loaded.run);
    if (const auto cost = cost_of_record(*loaded.run)) dearest = std::max(dearest, *cost);
    if (!observed.defined()) continue;
    if (const auto band = relative_uncertainty(quantity, *loaded.run, observed, bands))
      target.floor = std::max(target.floor, *band);
    variants.push_back(std::move(observed));
  }
  if (dearest > 0.0) target.cost = dearest;
  if (variants.empty()) {
    if (target.note.empty()) target.note = fmt::format("no record of '{}'", name);
    return target;
  }
  target.observed = mean_of(quantity, variants);
  for (std::size_t i = 0; i < variants.size(); ++i)
    for (std::size_t j = i + 1; j < variants.size(); ++j)
      target.floor =
          std::max(target.floor, 0.5 * relative_distance(quantity, variants[i], variants[j]).value_or(0.0));
  target.source += fmt::format(", {} record{}", variants.size(), variants.size() == 1 ? "" : "s");
  if (variants.size() == 1)
    target.note = target.floor > 0.0 ? "one record; its uncertainty is what seed, grid and slice move others"
                                     : "one record: its own uncertainty is not known from it";
  return target;
}

Target theory_target(const Run& run, const std::string& formula) {
  const FormulaEntry& entry = *find_formula(formula);
  Target target{"theory", std::string(entry.text), {}, 0.0, std::nullopt, ""};
  target.observed.value = entry.function(run, {});
  if (!target.observed.value) target.note = "the scene lacks what the formula needs";
  return target;
}

Target published_target(const Run& run, const std::string& file, const std::string& column) {
  Target target{"published", fmt::format("cases/published/{}", file), {}, 0.0, std::nullopt, ""};
  target.observed.curve = published_curve(run, file, column);
  return target;
}

Target own_target(const Quantity& quantity, const Run& finest, const std::string& method,
                  const Run* coarser) {
  Target target{kind_of_own,  fmt::format("{} on {:g} mm", method, 1e3 * finest.scene.grid.spacing[0]),
                {},           0.0,
                std::nullopt, ""};
  target.observed = observe(quantity, finest);
  target.note = target.observed.note;
  if (coarser)
    target.floor = relative_distance(quantity, observe(quantity, *coarser), target.observed).value_or(0.0);
  return target;
}

}  // namespace granvof::compare
