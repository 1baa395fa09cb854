#include "compare/checks/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "compare/checks/registry.hpp"
#include "compare/checks/theory.hpp"
#include "compare/checks/whole_curve.hpp"
#include "compare/input/records.hpp"
#include "compare/input/table_error.hpp"
#include "compare/input/uncertainty.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

constexpr const char* left_out_by_name = "left out by name";

struct ReferenceValue {
  std::optional<double> value;
  double band = 0.0;
  Verdict without = Verdict::not_run;  // the verdict where there is no value
  bool complete = true;                // false: a variant cannot be used, and the rest do not stand for it
  std::string note;
};

// Mean over the recorded variants; the band is the largest of the stated one, half their spread, and what
// bands.json says of the quantity.
ReferenceValue recorded_reference(const Check& check, const MetricEntry& metric,
                                  const std::vector<LoadedRun>& variants, const FindRun& find,
                                  const Bands& bands) {
  ReferenceValue reference;
  reference.band = check.reference.band;
  if (variants.empty()) {
    reference.note = fmt::format("no record of '{}'", *check.reference.record);
    return reference;
  }
  std::vector<double> values;
  for (const LoadedRun& variant : variants) {
    if (!variant.run) {
      reference.complete = false;
      if (reference.without == Verdict::error) continue;
      reference.note = variant.reason;
      reference.without = variant.state == RunState::stale ? Verdict::stale : Verdict::error;
      continue;
    }
    const Measured measured = metric.function(*variant.run, check.parameters, find);
    if (measured.value) {
      values.push_back(*measured.value);
      reference.band =
          std::max(reference.band, record_uncertainty(check.metric, *variant.run, bands).value_or(0.0));
    } else {
      reference.note = fmt::format("{}: {}", variant.run->directory.filename().string(), measured.note);
    }
  }
  if (values.empty() || !reference.complete) return reference;
  double sum = 0.0;
  for (const double value : values) sum += value;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  reference.value = sum / static_cast<double>(values.size());
  reference.band = std::max(reference.band, 0.5 * (*high - *low));
  return reference;
}

ReferenceValue stated_reference(const Check& check, const Run& run) {
  ReferenceValue reference;
  reference.band = check.reference.band;
  if (check.reference.formula) {
    reference.value = find_formula(*check.reference.formula)->function(run, check.parameters);
    if (!reference.value) reference.note = "the scene lacks what the formula needs";
  } else {
    reference.value = check.reference.value;
  }
  return reference;
}

ReferenceValue reference_of_curve(const CurveApart& apart) {
  ReferenceValue reference;
  if (apart.usable) reference.value = 0.0;
  reference.band = apart.band;
  reference.without = apart.without;
  reference.note = apart.note;
  return reference;
}

// A run that the row needs and that is not there, or holds nothing to measure, is never a pass; one that is
// damaged is red also where the row is only reported.
Result without_value(Result result, Verdict verdict, std::string note) {
  result.judgement.verdict = verdict;
  result.judgement.unexpected = result.check.asserted || verdict == Verdict::error;
  result.note = std::move(note);
  return result;
}

Verdict without_run(RunState state) {
  if (state == RunState::stale) return Verdict::stale;
  return state == RunState::refused ? Verdict::error : Verdict::not_run;
}

Result measure_and_judge(Result result, const Evaluation& evaluation, const Run& run,
                         const std::map<std::string, std::vector<LoadedRun>>& records, const Bands& bands) {
  const Check check = result.check;
  const MetricEntry& metric = *find_metric(check.metric);
  const FindRun find = [&](std::string_view id) -> const Run* {
    const auto found = evaluation.usable.find(std::string(id));
    return found == evaluation.usable.end() ? nullptr : &found->second;
  };
  CurveApart apart;
  if (metric.curve) apart = apart_from_record(check, metric, run, records.at(*check.reference.record), bands);
  const Measured measured = metric.curve ? apart.distance : metric.function(run, check.parameters, find);
  result.value = measured.value;
  const ReferenceValue reference =
      metric.curve ? reference_of_curve(apart)
      : check.reference.record
          ? recorded_reference(check, metric, records.at(*check.reference.record), find, bands)
          : stated_reference(check, run);
  result.reference = reference.value;
  result.band = reference.band;
  result.note = reference.note;
  if (metric.curve && !reference.value)
    return without_value(std::move(result), reference.without, reference.note);
  if (!measured.value)
    return without_value(std::move(result), check.asserted ? Verdict::differs : Verdict::reported,
                         measured.note);
  if (!std::isfinite(*measured.value))
    return without_value(std::move(result), Verdict::not_run, "refused: the metric is not finite");
  if (!reference.value) return without_value(std::move(result), reference.without, reference.note);
  result.judgement = judge(*measured.value, *reference.value, reference.band, check);
  return result;
}

Result evaluate_check(const Check& check, const Evaluation& evaluation, const RunSummary& summary,
                      const std::map<std::string, std::vector<LoadedRun>>& records, const Bands& bands,
                      const LeftOut& left_out) {
  Result result;
  result.check = check;
  result.unit = find_metric(check.metric)->unit;
  if (left_out.records && check.reference.record) {
    result.note = left_out_by_name;
    return result;
  }
  const auto own = evaluation.usable.find(check.run);
  if (own == evaluation.usable.end())
    return without_value(std::move(result), without_run(summary.state),
                         fmt::format("run {}", name_of(summary.state)));
  try {
    return measure_and_judge(result, evaluation, own->second, records, bands);
  } catch (const std::exception& error) {  // of a file that is read only now
    return without_value(std::move(result), Verdict::error, error.what());
  }
}

// The case that a record is held against: its own, whichever run is compared with it; that of the run where
// no case has the record's name.
Scene case_of_record(const std::filesystem::path& cases, const std::string& record, const Scene& of_run) {
  const auto file = cases / (record + ".toml");
  return std::filesystem::is_regular_file(file) ? load_scene(file) : of_run;
}

// A row for what is damaged and that no check may take.
Result damaged_result(const std::string& run, const LoadedRun& damaged) {
  Result result;
  result.check.id = fmt::format("evidence.{}", damaged.directory.string());
  result.check.run = run;
  result.check.metric = "evidence";
  result.check.reference.kind = ReferenceKind::regression;
  result.check.reference.source = damaged.directory.string();
  result.check.tolerance.unit = "-";
  result.unit = "-";
  return without_value(std::move(result), Verdict::error, damaged.reason);
}

}  // namespace

Result canary_result(const Canary& canary, const LeftOut& left_out) {
  Result result;
  result.check.id = "canary.reference.regression";
  result.check.run = "canary";
  result.check.metric = "reference";
  result.check.reference.kind = ReferenceKind::regression;
  result.check.reference.source = "reference/results/canary";
  result.check.tolerance.unit = "-";
  result.unit = "-";
  result.judgement.verdict = canary.verdict;
  result.judgement.unexpected = canary.verdict != Verdict::agrees && !left_out.canary;
  result.note = left_out.canary ? left_out_by_name : canary.note;
  return result;
}

int Evaluation::unexpected() const {
  return static_cast<int>(
      std::count_if(results.begin(), results.end(), [](const Result& r) { return r.judgement.unexpected; }));
}

std::vector<Check> due_checks(const Table& table, Frequency frequency) {
  std::vector<Check> due;
  for (const Check& check : table.checks)
    if (check.frequency <= frequency) due.push_back(check);
  return due;
}

std::vector<PlannedRun> due_runs(const Table& table, Frequency frequency) {
  std::set<std::string> needed;
  for (const Check& check : due_checks(table, frequency)) {
    needed.insert(check.run);
    if (check.parameters.against) needed.insert(*check.parameters.against);
  }
  std::vector<PlannedRun> due;
  for (const PlannedRun& run : table.runs)
    if (needed.contains(run.id)) due.push_back(run);
  return due;
}

std::vector<Order> orders_of(const Table& table, Frequency frequency, const Paths& paths) {
  std::set<std::string> timed;
  for (const Check& check : due_checks(table, frequency))
    if (find_metric(check.metric)->of_cost) timed.insert(check.run);
  std::vector<Order> orders;
  for (const PlannedRun& run : due_runs(table, frequency)) {
    Order order{run.id, paths.cases / (run.case_name + ".toml"), run.set, paths.runs / run.id};
    order.timed = timed.contains(run.id);
    orders.push_back(std::move(order));
  }
  return orders;
}

Evaluation evaluate(const Table& table, Frequency frequency, const Paths& paths, const LeftOut& left_out) {
  Evaluation evaluation;
  evaluation.causes = table.causes;
  const auto checks = due_checks(table, frequency);
  if (checks.empty())
    throw TableError(fmt::format("no check of the table is due at '{}'", name_of(frequency)));
  std::vector<Result> damaged;
  std::set<std::filesystem::path> named;
  const auto usable_of = [&](const std::string& run, const std::vector<LoadedRun>& loaded) {
    std::vector<Run> usable;
    for (const LoadedRun& one : loaded) {
      if (one.run) usable.push_back(*one.run);
      if (one.state == RunState::refused && named.insert(one.directory).second)
        damaged.push_back(damaged_result(run, one));
    }
    return usable;
  };
  std::map<std::string, Scene> scenes;
  for (const PlannedRun& plan : due_runs(table, frequency)) {
    const Scene scene = load_scene(paths.cases / (plan.case_name + ".toml"), plan.set);
    scenes.emplace(plan.id, scene);
    LoadedRun loaded = load_run(paths.runs / plan.id, plan.id, scene);
    evaluation.runs.push_back({plan, loaded.state, loaded.reason, loaded.facts});
    if (loaded.run) evaluation.usable.emplace(plan.id, std::move(*loaded.run));
    auto peers = usable_of(plan.id, load_peers(paths.records, plan.case_name, scene));
    if (!peers.empty()) evaluation.peers[plan.id] = std::move(peers);
  }
  const Bands bands = read_bands(paths.records);
  std::map<std::string, std::vector<LoadedRun>> records;
  const auto load = [&](const std::string& name, const Scene& of_run) {
    if (left_out.records || records.contains(name)) return;
    const Scene scene = case_of_record(paths.cases, name, of_run);
    records[name] = load_records(paths.records, name, scene);
    auto usable = usable_of(scene.name, records[name]);
    if (!usable.empty()) evaluation.records[name] = std::move(usable);
  };
  for (const Check& check : checks)
    if (check.reference.record) load(*check.reference.record, scenes.at(check.run));
  // The plots show a record also where no row is judged by it.
  for (const PlannedRun& plan : due_runs(table, frequency))
    if (plan.set.empty()) load(plan.case_name, scenes.at(plan.id));
  for (const Check& check : checks) {
    const auto summary = std::find_if(evaluation.runs.begin(), evaluation.runs.end(),
                                      [&](const RunSummary& run) { return run.plan.id == check.run; });
    evaluation.results.push_back(evaluate_check(check, evaluation, *summary, records, bands, left_out));
  }
  evaluation.results.insert(evaluation.results.end(), damaged.begin(), damaged.end());
  return evaluation;
}

}  // namespace granvof::compare
