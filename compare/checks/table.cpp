#include "compare/checks/table.hpp"

#include <algorithm>
#include <ranges>
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

Frequency read_frequency(const TomlEntry& entry) {
  return entry.one_of("frequency",
                      {Frequency::short_, Frequency::verify, Frequency::nightly, Frequency::weekly});
}

// What becomes part of a path must not lead out of it.
void require_name(const TomlEntry& entry, std::string_view key, const std::string& name) {
  if (!is_name(name))
    entry.fail(
        key,
        fmt::format("'{}' given; a name has letters, digits and -_. and begins with none of these", name));
}

PlannedRun read_run(const TomlEntry& entry) {
  entry.allow_only({"id", "case", "set", "beside", "frequency"});
  PlannedRun run;
  run.id = entry.text("id");
  if (entry.has("set")) run.set = entry.assignments("set");
  if (entry.has("beside")) run.beside = entry.text("beside");
  if (run.beside && run.set.empty()) entry.fail("beside", "without 'set' it is the run it stands beside");
  run.case_name = entry.has("case") ? entry.text("case") : run.beside.value_or(run.id);
  require_name(entry, "id", run.id);
  const std::size_t slash = run.case_name.find('/');  // it may be in a folder of cases
  if (slash != std::string::npos) require_name(entry, "case", run.case_name.substr(0, slash));
  require_name(entry, "case", run.case_name.substr(slash == std::string::npos ? 0 : slash + 1));
  if (run.beside) require_name(entry, "beside", *run.beside);
  if (entry.has("frequency")) {
    if (!run.beside) entry.fail("frequency", "only a run beside another has one: its checks are that run's");
    run.frequency = read_frequency(entry);
  }
  return run;
}

Parameters read_parameters(const TomlEntry& check, const MetricEntry& metric) {
  Parameters parameters;
  for (const ParameterEntry& parameter : granvof::compare::parameters()) {
    const bool needed = metric.needs.*parameter.needed;
    if (needed && !check.has(parameter.key))
      check.fail("metric", fmt::format("{} needs the key '{}'", metric.name, parameter.key));
    if (!needed && check.has(parameter.key))
      check.fail(parameter.key, fmt::format("{} takes no such parameter", metric.name));
    if (needed) parameter.read(check, parameters);
  }
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
                                         ReferenceKind::aim, ReferenceKind::regression});
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
  if (metric.curve && (reference.kind != ReferenceKind::dem || reference.value || reference.formula))
    entry.fail("kind", fmt::format("{} is judged by a record alone: kind DEM, without value", metric.name));
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
  std::string id = fmt::format("{}.{}", check.run, labelled(check.metric, check.parameters));
  if (!check.label.empty()) id += fmt::format(".{}", check.label);
  return id + fmt::format(".{}", name_of(check.reference.kind));
}

// The record of a row's run is that of its case.
Check row(Check check, const Reference& reference, std::optional<double> at, const PlannedRun& run) {
  check.run = run.id;
  check.parameters.at = at;
  check.reference = reference;
  if (!reference.value && !reference.formula && !reference.record) {
    check.reference.record = run.case_name;
    if (reference.source.empty()) check.reference.source = source_of_record(run.case_name);
  }
  check.id = id_of(check);
  return check;
}

// An expected failure of some of a check's runs, at some of its instants.
struct Expected {
  std::string reason;
  std::vector<std::string> runs;
  std::vector<std::optional<double>> instants;
  std::vector<double> distances;  // one for each instant
  std::string cause;

  std::optional<ExpectedFailure> of(const std::string& run, std::optional<double> at) const {
    if (std::ranges::find(runs, run) == runs.end()) return std::nullopt;
    const auto found = std::ranges::find(instants, at);
    if (found == instants.end()) return std::nullopt;
    return ExpectedFailure{reason, distances[static_cast<std::size_t>(found - instants.begin())], cause};
  }
};

// Without `run` those that the check names, without `at` all of its instants.
Expected read_expected(const TomlEntry& entry, const std::vector<std::string>& runs,
                       const std::vector<std::optional<double>>& instants, const std::vector<Cause>& causes) {
  entry.allow_only({"reason", "distance", "run", "at", "cause"});
  Expected expected{entry.text("reason"), runs, instants, entry.non_negatives("distance"), ""};
  if (!causes.empty() || entry.has("cause")) {
    expected.cause = entry.text("cause");
    if (std::ranges::find(causes, expected.cause, &Cause::key) == causes.end())
      entry.fail("cause",
                 fmt::format("'{}' given, which no [[cause]] declares; there are: {}", expected.cause,
                             fmt::join(causes | std::views::transform(&Cause::key), ", ")));
  }
  if (entry.has("run")) expected.runs = entry.texts("run");
  if (entry.has("at")) {
    const std::vector<double> given = entry.numbers("at");
    expected.instants.assign(given.begin(), given.end());
    for (const auto& at : expected.instants)
      if (std::ranges::find(instants, at) == instants.end())
        entry.fail("at", fmt::format("{} given, which is no instant of the check", *at));
  }
  const std::size_t count = expected.instants.size();
  if (expected.distances.size() == 1) expected.distances.resize(count, expected.distances.front());
  if (expected.distances.size() != count)
    entry.fail("distance", fmt::format("{} numbers given; allowed: one, or as many as 'at' has ({})",
                                       expected.distances.size(), count));
  return expected;
}

const PlannedRun& find_run(const TomlEntry& entry, std::string_view key, const std::string& id,
                           const std::vector<PlannedRun>& runs) {
  const auto found = std::ranges::find(runs, id, &PlannedRun::id);
  if (found != runs.end()) return *found;
  std::set<std::string_view> there;
  for (const PlannedRun& run : runs) there.insert(run.id);
  entry.fail(key, fmt::format("no [[run]] has the id '{}'; there are: {}", id, fmt::join(there, ", ")));
}

// The run beside `id` that is made as `like` is.
std::string beside(const TomlEntry& entry, const std::string& id, const PlannedRun& like,
                   const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs)
    if (run.beside == id && run.set == like.set) return run.id;
  entry.fail("against", fmt::format("no [[run]] beside '{}' has the 'set' of '{}'", id, like.id));
}

std::vector<const PlannedRun*> pointers_to(const std::vector<PlannedRun>& runs) {
  std::vector<const PlannedRun*> all;
  for (const PlannedRun& run : runs) all.push_back(&run);
  return all;
}

// Those that a check names, and those beside them.
std::vector<const PlannedRun*> runs_of(const TomlEntry& entry, const std::vector<std::string>& named,
                                       const std::vector<PlannedRun>& runs) {
  std::vector<const PlannedRun*> made;
  for (const std::string& id : named) made.push_back(&find_run(entry, "run", id, runs));
  for (const PlannedRun& run : runs)
    if (run.beside && std::ranges::find(named, *run.beside) != named.end()) made.push_back(&run);
  return made;
}

// A check of every run that some other check reads: no run is judged without it.
constexpr std::string_view every_run = "*";

bool is_of_every_run(const TomlEntry& check) {
  return check.texts("run") == std::vector<std::string>{std::string(every_run)};
}

// Runs that the rows read, each as often as it is read most often.
std::vector<PlannedRun> runs_read(const std::vector<PlannedRun>& runs, const std::vector<Check>& checks) {
  std::vector<PlannedRun> read;
  for (PlannedRun run : runs) {
    std::optional<Frequency> most;
    for (const Check& check : checks)
      if (check.run == run.id || check.parameters.against == run.id)
        most = most ? std::min(*most, check.frequency) : check.frequency;
    if (!most) continue;
    run.frequency = *most;
    read.push_back(std::move(run));
  }
  return read;
}

std::vector<Expected> read_failures(const TomlEntry& check, const std::vector<std::string>& named,
                                    const std::vector<const PlannedRun*>& made,
                                    const std::vector<std::optional<double>>& instants,
                                    const std::vector<Cause>& causes) {
  std::vector<Expected> failures;
  if (!check.has("expected_failure")) return failures;
  for (const TomlEntry& entry : check.entry_or_entries("expected_failure")) {
    if (is_of_every_run(check) && !entry.has("run"))
      entry.fail("", "the key 'run' is missing: of which runs of all?");
    failures.push_back(read_expected(entry, named, instants, causes));
    for (const std::string& id : failures.back().runs)
      if (std::ranges::none_of(made, [&](const PlannedRun* run) { return run->id == id; }))
        entry.fail("run", fmt::format("'{}' given, which is no run of the check", id));
  }
  return failures;
}

// A row for each of its references, instants and runs, and of the runs beside those; `runs` are those that
// there are, of a check of every run those that others read.
std::vector<Check> read_check(const TomlEntry& entry, const std::vector<PlannedRun>& runs,
                              const std::vector<Cause>& causes) {
  std::vector<std::string_view> keys{"run",      "metric",    "reference",        "relation", "tolerance",
                                     "asserted", "frequency", "expected_failure", "label"};
  for (const ParameterEntry& parameter : parameters()) keys.push_back(parameter.key);
  entry.allow_only(keys);
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
  const bool of_every_run = is_of_every_run(entry);
  if (of_every_run && entry.has("frequency"))
    entry.fail("frequency", "a check of every run is made of each as often as another one is");
  check.frequency = of_every_run ? Frequency::short_ : read_frequency(entry);
  if (entry.has("label")) check.label = entry.text("label");
  std::vector<std::optional<double>> instants{std::nullopt};
  if (metric->needs.at) {
    const std::vector<double> given = entry.numbers("at");
    instants.assign(given.begin(), given.end());
  }
  std::vector<std::string> named = entry.texts("run");
  if (of_every_run) {
    named.clear();
    for (const PlannedRun& run : runs) named.push_back(run.id);
  }
  const std::vector<const PlannedRun*> made = of_every_run ? pointers_to(runs) : runs_of(entry, named, runs);
  if (check.parameters.against) find_run(entry, "against", *check.parameters.against, runs);
  const std::vector<Expected> failures = read_failures(entry, named, made, instants, causes);
  if (!failures.empty() && !check.asserted)
    entry.fail("expected_failure", "a row that is not asserted cannot fail");
  std::vector<Check> checks;
  for (const TomlEntry& reference : entry.entry_or_entries("reference")) {
    const Reference read = read_reference(reference, *metric);
    for (const auto& at : instants)
      for (const PlannedRun* run : made) {
        // What this code gave before is of the run itself.
        const bool named_run = std::ranges::find(named, run->id) != named.end();
        if (!named_run && read.kind == ReferenceKind::regression) continue;
        Check shared = check;
        if (of_every_run || !named_run) shared.frequency = std::max(check.frequency, run->frequency);
        if (!named_run && check.parameters.against)
          shared.parameters.against = beside(entry, *check.parameters.against, *run, runs);
        Check one = row(std::move(shared), read, at, *run);
        for (const Expected& failure : failures) {
          const auto expected = failure.of(run->id, at);
          if (!expected) continue;
          if (one.expected_failure)
            entry.fail("expected_failure", fmt::format("'{}' is in two of them", one.id));
          one.expected_failure = expected;
        }
        checks.push_back(std::move(one));
      }
  }
  return checks;
}

Table read_root(const toml::table& root, std::string_view name) {
  const TomlEntry top(root, "table", name);
  top.allow_only({"run", "check", "cause"});
  Table table;
  std::set<std::string> runs, checks;
  for (const TomlEntry& entry : top.entries("run")) {
    table.runs.push_back(read_run(entry));
    if (!runs.insert(table.runs.back().id).second)
      entry.fail("id", fmt::format("'{}' is given twice", table.runs.back().id));
  }
  for (const TomlEntry& entry : top.entries("run"))
    if (entry.has("beside")) find_run(entry, "beside", entry.text("beside"), table.runs);
  std::set<std::string> causes;
  for (const TomlEntry& entry : top.entries("cause")) {
    entry.allow_only({"key", "text"});
    table.causes.push_back({entry.text("key"), entry.text("text")});
    if (!causes.insert(table.causes.back().key).second)
      entry.fail("key", fmt::format("'{}' is given twice", table.causes.back().key));
  }
  std::set<std::string> used;
  const auto add_checks_of = [&](bool every_one, const std::vector<PlannedRun>& of) {
    for (const TomlEntry& entry : top.entries("check")) {
      if (is_of_every_run(entry) != every_one) continue;
      for (Check& check : read_check(entry, of, table.causes)) {
        if (check.expected_failure) used.insert(check.expected_failure->cause);
        if (!checks.insert(check.id).second)
          entry.fail("", fmt::format("'{}' is checked twice; give the second a 'label'", check.id));
        table.checks.push_back(std::move(check));
      }
    }
  };
  add_checks_of(false, table.runs);
  add_checks_of(true, runs_read(table.runs, table.checks));
  for (const TomlEntry& entry : top.entries("cause"))
    if (!used.contains(entry.text("key"))) entry.fail("key", "no expected failure has this cause");
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
