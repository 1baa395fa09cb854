#include "compare/checks/table.hpp"

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "compare/checks/registry.hpp"
#include "compare/checks/theory.hpp"
#include "compare/input/name.hpp"
#include "compare/input/toml_entry.hpp"

namespace granvof::compare {
namespace {

template <typename Entries>
std::string names_of(const Entries& entries) {
  std::vector<std::string_view> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// What becomes part of a path must not lead out of it.
void require_name(const TomlEntry& entry, std::string_view key, const std::string& name) {
  if (!is_name(name))
    entry.fail(
        key,
        fmt::format("'{}' given; a name has letters, digits and -_. and begins with none of these", name));
}

PlannedRun read_run(const TomlEntry& entry) {
  entry.allow_only({"id", "case", "set"});
  PlannedRun run;
  run.id = entry.text("id");
  run.case_name = entry.has("case") ? entry.text("case") : run.id;
  require_name(entry, "id", run.id);
  require_name(entry, "case", run.case_name);
  if (entry.has("set")) run.set = entry.assignments("set");
  return run;
}

Parameters read_parameters(const TomlEntry& check, const MetricEntry& metric) {
  Parameters parameters;
  const auto need = [&](bool needed, std::string_view key) {
    if (needed && !check.has(key))
      check.fail("metric", fmt::format("{} needs the key '{}'", metric.name, key));
    if (!needed && check.has(key)) check.fail(key, fmt::format("{} takes no such parameter", metric.name));
    return needed;
  };
  if (need(metric.needs.window, "window")) parameters.window = check.window("window");
  need(metric.needs.at, "at");  // read by its caller: it may be a list
  if (need(metric.needs.quiet, "quiet")) parameters.quiet = check.non_negative("quiet");
  if (need(metric.needs.level, "level")) parameters.level = check.number("level");
  if (need(metric.needs.published, "published")) parameters.published = check.text("published");
  if (need(metric.needs.published, "column")) parameters.column = check.text("column");
  if (need(metric.needs.against, "against")) parameters.against = check.text("against");
  return parameters;
}

std::string source_of_record(std::string_view record) {
  return fmt::format("reference/results/{}", record);
}

// A reference of kind DEM without a record, value or formula stands for the record of each row's run.
Reference read_reference(const TomlEntry& entry, const MetricEntry& metric) {
  entry.allow_only({"kind", "source", "value", "formula", "record", "band"});
  Reference reference;
  reference.kind = entry.one_of("kind", {ReferenceKind::theory, ReferenceKind::published, ReferenceKind::dem,
                                         ReferenceKind::regression});
  const int given = int{entry.has("value")} + int{entry.has("formula")} + int{entry.has("record")};
  const bool own_record = given == 0 && reference.kind == ReferenceKind::dem;
  if (given != 1 && !own_record)
    entry.fail("",
               "give exactly one of 'value', 'formula' and 'record' (DEM: or none, the record of the run)");
  if (entry.has("value")) reference.value = entry.number("value");
  if (entry.has("formula")) {
    reference.formula = entry.text("formula");
    const FormulaEntry* formula = find_formula(*reference.formula);
    if (!formula)
      entry.fail("formula", fmt::format("'{}' given; allowed: {}", *reference.formula, names_of(formulas())));
    if (formula->unit != metric.unit)
      entry.fail("formula", fmt::format("{} is in {}, the metric {} in {}", formula->name, formula->unit,
                                        metric.name, metric.unit));
    reference.source = formula->text;
  }
  if (entry.has("record")) {
    if (reference.kind != ReferenceKind::dem)
      entry.fail("record", "only a reference of kind DEM has a record");
    reference.record = entry.text("record");
    require_name(entry, "record", *reference.record);
    reference.source = source_of_record(*reference.record);
  }
  if (entry.has("source"))
    reference.source = entry.text("source");
  else if (reference.source.empty() && !own_record)
    entry.fail("", "the key 'source' is missing: where does the value come from?");
  if (entry.has("band")) reference.band = entry.non_negative("band");
  return reference;
}

Tolerance read_tolerance(const TomlEntry& entry, const MetricEntry& metric) {
  entry.allow_only({"absolute", "relative", "unit"});
  Tolerance tolerance;
  tolerance.relative = entry.has("relative");
  if (tolerance.relative == entry.has("absolute")) entry.fail("", "give one of 'absolute' and 'relative'");
  if (tolerance.relative) {
    if (entry.has("unit")) entry.fail("unit", "a relative tolerance has no unit");
    tolerance.value = entry.non_negative("relative");
    return tolerance;
  }
  tolerance.value = entry.non_negative("absolute");
  tolerance.unit = entry.text("unit");
  if (tolerance.unit != metric.unit)
    entry.fail("unit", fmt::format("'{}' given; {} is in {}", tolerance.unit, metric.name, metric.unit));
  return tolerance;
}

std::string id_of(const Check& check) {
  std::string id = fmt::format("{}.{}", check.run, check.metric);
  if (check.parameters.at) id += fmt::format("@{}", *check.parameters.at);
  if (check.parameters.against) id += fmt::format("-{}", *check.parameters.against);
  if (check.parameters.column) id += fmt::format("-{}", *check.parameters.column);
  if (!check.label.empty()) id += fmt::format(".{}", check.label);
  return id + fmt::format(".{}", name_of(check.reference.kind));
}

Check row(Check check, const Reference& reference, std::optional<double> at, const std::string& run) {
  check.run = run;
  check.parameters.at = at;
  check.reference = reference;
  if (!reference.value && !reference.formula && !reference.record) {
    check.reference.record = run;
    if (reference.source.empty()) check.reference.source = source_of_record(run);
  }
  check.id = id_of(check);
  return check;
}

// One for each of the check's instants; none where it is not expected to fail.
std::vector<ExpectedFailure> read_expected_failures(const TomlEntry& check, std::size_t instants) {
  if (!check.has("expected_failure")) return {};
  const TomlEntry entry = check.entry("expected_failure");
  entry.allow_only({"reason", "distance"});
  std::vector<double> distances = entry.non_negatives("distance");
  if (distances.size() == 1) distances.resize(instants, distances.front());
  if (distances.size() != instants)
    entry.fail("distance", fmt::format("{} numbers given; allowed: one, or as many as 'at' has ({})",
                                       distances.size(), instants));
  std::vector<ExpectedFailure> failures(instants, {entry.text("reason"), 0.0});
  for (std::size_t i = 0; i < instants; ++i) failures[i].distance = distances[i];
  return failures;
}

// A row for each of its references, instants and runs.
std::vector<Check> read_check(const TomlEntry& entry) {
  entry.allow_only({"run", "metric", "window", "at", "quiet", "level", "published", "column", "against",
                    "reference", "relation", "tolerance", "asserted", "frequency", "expected_failure",
                    "label"});
  Check check;
  check.line = entry.line();
  check.metric = entry.text("metric");
  const MetricEntry* metric = find_metric(check.metric);
  if (!metric)
    entry.fail("metric", fmt::format("'{}' given; allowed: {}", check.metric, names_of(metrics())));
  check.parameters = read_parameters(entry, *metric);
  check.tolerance = read_tolerance(entry.entry("tolerance"), *metric);
  if (entry.has("relation"))
    check.relation = entry.one_of("relation", {Relation::equal, Relation::at_most, Relation::at_least});
  if (entry.has("asserted")) check.asserted = entry.truth("asserted");
  check.frequency = entry.one_of(
      "frequency", {Frequency::short_, Frequency::verify, Frequency::nightly, Frequency::weekly});
  if (entry.has("label")) check.label = entry.text("label");
  std::vector<std::optional<double>> instants{std::nullopt};
  if (metric->needs.at) {
    const std::vector<double> given = entry.numbers("at");
    instants.assign(given.begin(), given.end());
  }
  const auto failures = read_expected_failures(entry, instants.size());
  if (!failures.empty() && !check.asserted)
    entry.fail("expected_failure", "a row that is not asserted cannot fail");
  std::vector<Check> checks;
  for (const TomlEntry& reference : entry.entry_or_entries("reference")) {
    const Reference read = read_reference(reference, *metric);
    for (std::size_t i = 0; i < instants.size(); ++i) {
      if (!failures.empty()) check.expected_failure = failures[i];
      for (const std::string& run : entry.texts("run")) checks.push_back(row(check, read, instants[i], run));
    }
  }
  return checks;
}

Table read_root(const toml::table& root, std::string_view name) {
  const TomlEntry top(root, "table", name);
  top.allow_only({"run", "check"});
  Table table;
  std::set<std::string> runs, checks;
  for (const TomlEntry& entry : top.entries("run")) {
    table.runs.push_back(read_run(entry));
    if (!runs.insert(table.runs.back().id).second)
      entry.fail("id", fmt::format("'{}' is given twice", table.runs.back().id));
  }
  const auto require_run = [&](const TomlEntry& entry, std::string_view key, const std::string& run) {
    if (!runs.contains(run))
      entry.fail(key, fmt::format("no [[run]] has the id '{}'; there are: {}", run, fmt::join(runs, ", ")));
  };
  for (const TomlEntry& entry : top.entries("check"))
    for (Check& check : read_check(entry)) {
      require_run(entry, "run", check.run);
      if (check.parameters.against) require_run(entry, "against", *check.parameters.against);
      if (!checks.insert(check.id).second)
        entry.fail("", fmt::format("'{}' is checked twice; give the second a 'label'", check.id));
      table.checks.push_back(std::move(check));
    }
  if (table.checks.empty()) throw TableError(fmt::format("{}: there is no [[check]]", name));
  return table;
}

}  // namespace

Table parse_table(std::string_view text, std::string_view name) {
  return read_root(parse_toml(text, name), name);
}

Table read_table(const std::filesystem::path& file) {
  return read_root(parse_toml_file(file), file.string());
}

}  // namespace granvof::compare
