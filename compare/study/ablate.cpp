#include "compare/study/ablate.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "compare/checks/registry.hpp"
#include "compare/checks/theory.hpp"
#include "compare/input/records.hpp"
#include "compare/output/write.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr double longest_gate = 0.1;  // in times sqrt(h0 / g), that a gate may stand under a lid

std::vector<std::string> rigid_lid(const Scene& scene) {
  double level = 0.0;
  for (const Box& box : scene.liquid_boxes) {
    if (box.upper[0] - box.lower[0] < scene.tank[0] * (1.0 - 1e-9) || box.lower[1] > 0.0)
      throw std::invalid_argument("the liquid does not fill the tank up to a level");
    level = std::max(level, box.upper[1]);
  }
  if (level <= 0.0) throw std::invalid_argument("the scene has no liquid");
  if (scene.bed && scene.bed->box.upper[1] > level * (1.0 + 1e-9))
    throw std::invalid_argument("the bed reaches above the liquid");
  // Under a lid a gate shuts the column's side but for the gap below its edge: what runs out must be replaced
  // through the same gap. s1 at 2.5 mm, T = 2 / 5: -0.16 / -0.22 of run-out with its gate, -0.04 / -0.06 with
  // one of 20 m/s.
  if (scene.gate) {
    const double height = scene.bed ? scene.bed->box.upper[1] - scene.bed->box.lower[1] : level;
    const double stands = level / scene.gate->speed / std::sqrt(height / scene.gravity);
    if (stands > longest_gate)
      throw std::invalid_argument(
          fmt::format("under a lid the gate shuts the column's side, for T = {:.2g}; at most {:g}", stands,
                      longest_gate));
  }
  const double rows = level / scene.grid.spacing[1];
  if (std::abs(rows - std::round(rows)) > 1e-6)
    throw std::invalid_argument(
        fmt::format("the level {:g} m is no whole number of cells of {:g} m", level, scene.grid.spacing[1]));
  const std::string depth = scene.dimensions == 3 ? fmt::format(", {:.12g}", scene.tank[2]) : "";
  return {fmt::format("tank.size=[{:.12g}, {:.12g}{}]", scene.tank[0], level, depth), "walls.top=slip"};
}

std::vector<std::string> two_dimensions(const Scene& scene) {
  if (scene.dimensions == 2) throw std::invalid_argument("the scene is in two dimensions already");
  return {"scene.dimensions=2", fmt::format("tank.size=[{:.12g}, {:.12g}]", scene.tank[0], scene.tank[1])};
}

std::optional<double> bound_of(const Check& check, const Run& run) {
  return check.reference.formula ? find_formula(*check.reference.formula)->function(run, check.parameters)
                                 : check.reference.value;
}

bool inside(Relation relation, double value, double bound, double tolerance) {
  return relation == Relation::at_most ? value <= bound + tolerance : value >= bound - tolerance;
}

std::optional<double> measure(const Check& check, const Run& run) {
  const FindRun none = [](std::string_view) -> const Run* { return nullptr; };
  const Measured measured = find_metric(check.metric)->function(run, check.parameters, none);
  return measured.value && std::isfinite(*measured.value) ? measured.value : std::nullopt;
}

// What the row holds the metric to; nothing for a bound, or where no record of the scene can be read.
std::optional<double> reference_of(const Check& check, const Run& run, const fs::path& records) {
  if (check.relation != Relation::equal) return std::nullopt;
  if (!check.reference.record) return bound_of(check, run);
  double sum = 0.0;
  int count = 0;
  for (const LoadedRun& variant : load_records(records, *check.reference.record, run.scene)) {
    if (variant.state == RunState::refused) throw std::runtime_error(variant.reason);
    const auto value = variant.run ? measure(check, *variant.run) : std::nullopt;
    sum += value.value_or(0.0);
    count += value ? 1 : 0;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

Effect effect_of_curve(const AblatedMetric& metric, const Run& run) {
  Effect effect;
  effect.tolerance = metric.check.tolerance.value;
  effect.value = relative_distance(*metric.curve, observe(*metric.curve, run), metric.full_curve);
  effect.change = effect.value;
  effect.beyond = !effect.value || *effect.value > effect.tolerance;
  return effect;
}

Effect effect_of(const AblatedMetric& metric, const Run& run) {
  if (metric.curve) return effect_of_curve(metric, run);
  Effect effect;
  const Check& check = metric.check;
  effect.value = measure(check, run);
  effect.tolerance = check.tolerance.value;
  if (check.tolerance.relative) effect.tolerance *= std::abs(metric.full.value_or(0.0));
  if (!effect.value || !metric.full) {
    effect.beyond = effect.value.has_value() != metric.full.has_value();
    return effect;
  }
  effect.change = *effect.value - *metric.full;
  effect.beyond = std::abs(*effect.change) > effect.tolerance;
  if (check.relation == Relation::equal) return effect;
  if (const auto bound = bound_of(check, run))
    effect.beyond = inside(check.relation, *effect.value, *bound, effect.tolerance) !=
                    inside(check.relation, *metric.full, *bound, effect.tolerance);
  return effect;
}

Ablation row_of(const std::string& name, const Outcome& outcome, const std::vector<AblatedMetric>& metrics) {
  Ablation row;
  row.name = name;
  row.failure = outcome.failure;
  row.applies = !outcome.refused;
  row.cost = outcome.cost();
  row.core_seconds = outcome.core_seconds;
  row.work = outcome.work();
  if (outcome.run)
    for (const AblatedMetric& metric : metrics) row.effects.push_back(effect_of(metric, *outcome.run));
  return row;
}

}  // namespace

bool Ablation::dispensable() const {
  return applies && failure.empty() &&
         std::none_of(effects.begin(), effects.end(), [](const Effect& e) { return e.beyond; });
}

std::vector<Part> parts_for(const std::vector<Part>& parts, const Scene& scene) {
  std::vector<Part> all;
  for (const Part& part : parts) {
    if (part.form != Form::each_choice) {
      all.push_back(part);
      continue;
    }
    for (const case_file::ChoiceOfScene& choice : case_file::choices_of(scene))
      for (std::string value : choice.others) {
        std::erase(value, '"');
        const std::string key = choice.key.substr(choice.key.find('.') + 1);
        all.push_back({key + " = " + value, {choice.key + "=" + value}, std::nullopt, choice.reason});
      }
  }
  return all;
}

std::vector<std::string> overrides_of(const Part& part, const Scene& scene) {
  if (!part.form) return part.set;
  switch (*part.form) {
    case Form::rigid_lid:
      return rigid_lid(scene);
    case Form::two_dimensions:
      return two_dimensions(scene);
    case Form::each_choice:
      break;
  }
  throw std::invalid_argument("it stands for several parts");
}

std::vector<Check> metrics_of_scene(const Table& table, const std::string& scene) {
  std::vector<Check> chosen;
  std::set<std::string> seen;
  for (const Check& check : table.checks) {
    if (check.run != scene || check.parameters.against || find_metric(check.metric)->of_cost) continue;
    if (check.reference.kind == ReferenceKind::regression) continue;
    if (seen.insert(metric_label(check)).second) chosen.push_back(check);
  }
  return chosen;
}

Check check_of(const Quantity& quantity, double tolerance, const std::vector<Check>& rows) {
  for (const Check& row : rows)
    if (!quantity.is_curve && row.metric == quantity.name && row.parameters.at == quantity.parameters.at)
      return row;
  Check check;
  check.metric = quantity.name;
  check.label = quantity.is_curve ? "curve" : "";
  check.parameters = quantity.parameters;
  check.tolerance = {tolerance, true, ""};
  return check;
}

AblateReport ablate(const fs::path& case_file, const std::vector<std::string>& set,
                    const std::vector<Part>& parts, const std::vector<Check>& checks, const fs::path& records,
                    Runner& runner, const std::vector<Quantity>& curves, double curve_tolerance) {
  if (checks.empty() && curves.empty())
    throw std::runtime_error(
        fmt::format("{}: the table of checks has no metric of this scene; --metric names what to look at",
                    case_file.string()));
  const Scene scene = load_scene(case_file, set);
  const Outcome full = runner.run({case_file, set});
  if (!full.run) throw std::runtime_error(fmt::format("{}: {}", scene.name, full.failure));

  AblateReport report{scene.name, full.facts->version, full.facts->case_hash, full.facts->host, set, {}, {}};
  if (!full.facts->commit.empty()) report.version += fmt::format(" ({})", full.facts->commit);
  for (const Check& check : checks)
    report.metrics.push_back({check, std::string(find_metric(check.metric)->unit), measure(check, *full.run),
                              reference_of(check, *full.run, records)});
  for (const Quantity& quantity : curves) {
    Observed whole = observe(quantity, *full.run);
    if (!whole.defined()) throw std::runtime_error(fmt::format("{}: {}", scene.name, whole.note));
    report.metrics.push_back(
        {check_of(quantity, curve_tolerance, {}), "-", 0.0, std::nullopt, quantity, std::move(whole)});
  }
  report.rows.push_back(row_of("full model", full, report.metrics));
  report.rows.back().set = set;
  for (const Part& part : parts_for(parts, scene)) {
    Ablation row;
    std::vector<std::string> all = set;
    try {
      for (const std::string& assignment : overrides_of(part, scene)) all.push_back(assignment);
      row = row_of(part.name, runner.run({case_file, all}), report.metrics);
    } catch (const std::invalid_argument& error) {
      row.name = part.name;
      row.applies = false;
      row.failure = error.what();
    }
    row.set = all;
    row.about = part.about;
    report.rows.push_back(std::move(row));
  }
  return report;
}

std::vector<Job> jobs_of_ablation(const fs::path& case_file, const std::vector<std::string>& set,
                                  const std::vector<Part>& parts) {
  const Scene scene = load_scene(case_file, set);
  std::vector<Job> jobs{{case_file, set}};
  for (const Part& part : parts_for(parts, scene)) {
    std::vector<std::string> all = set;
    try {
      for (const std::string& assignment : overrides_of(part, scene)) all.push_back(assignment);
      jobs.push_back({case_file, all});
    } catch (const std::invalid_argument&) {  // it does not apply to the scene
    }
  }
  return jobs;
}

}  // namespace granvof::compare
