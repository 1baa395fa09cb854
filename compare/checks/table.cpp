#include "compare/checks/table.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "compare/checks/registry.hpp"
#include "compare/checks/theory.hpp"

namespace granvof::compare {
namespace {

// A table of the file together with where it stands, so that every complaint names its place.
class Entry {
 public:
  Entry(const toml::table& table, std::string path, std::string_view file)
      : table_(table), path_(std::move(path)), file_(file) {}

  [[noreturn]] void fail(std::string_view key, std::string_view what) const {
    const toml::node* node = table_.get(key);
    const auto line = (node ? node->source() : table_.source()).begin.line;
    throw TableError(
        fmt::format("{}:{}: {}{}: {}", file_, line, path_, key.empty() ? "" : fmt::format(".{}", key), what));
  }

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        fail(key.str(), fmt::format("unknown key; allowed: {}", fmt::join(keys, ", ")));
  }

  bool has(std::string_view key) const { return table_.contains(key); }
  int line() const { return static_cast<int>(table_.source().begin.line); }

  std::string text(std::string_view key) const {
    const auto value = require(key).value_exact<std::string>();
    if (!value || value->empty()) fail(key, "expected a text that is not empty");
    return *value;
  }

  double number(std::string_view key) const { return number_of(require(key), key); }

  double non_negative(std::string_view key) const {
    const double value = number(key);
    if (value < 0.0) fail(key, fmt::format("{} given; allowed: 0 or more", value));
    return value;
  }

  bool truth(std::string_view key) const {
    const auto value = require(key).value_exact<bool>();
    if (!value) fail(key, "expected true or false");
    return *value;
  }

  std::vector<std::string> texts(std::string_view key) const {
    const toml::array* array = require(key).as_array();
    if (!array) return {text(key)};
    std::vector<std::string> list;
    for (const toml::node& node : *array) {
      const auto value = node.value_exact<std::string>();
      if (!value || value->empty()) fail(key, "expected texts that are not empty");
      list.push_back(*value);
    }
    if (list.empty()) fail(key, "the list is empty");
    return list;
  }

  Window window(std::string_view key) const {
    const toml::array* array = require(key).as_array();
    if (!array || array->size() != 2) fail(key, "expected two numbers [begin, end]");
    const Window window{number_of(*array->get(0), key), number_of(*array->get(1), key)};
    if (!(window.begin < window.end))
      fail(key, fmt::format("[{}, {}] given; begin must come before end", window.begin, window.end));
    return window;
  }

  Entry entry(std::string_view key) const {
    const toml::table* inner = require(key).as_table();
    if (!inner) fail(key, "expected a table { ... }");
    return {*inner, fmt::format("{}.{}", path_, key), file_};
  }

  // The member of `all` whose name_of() is given under `key`.
  template <typename Enum>
  Enum one_of(std::string_view key, std::initializer_list<Enum> all) const {
    const std::string given = text(key);
    std::vector<std::string_view> names;
    for (const Enum member : all) {
      if (name_of(member) == given) return member;
      names.push_back(name_of(member));
    }
    fail(key, fmt::format("'{}' given; allowed: {}", given, fmt::join(names, ", ")));
  }

 private:
  const toml::node& require(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (!node) fail("", fmt::format("the key '{}' is missing", key));
    return *node;
  }

  double number_of(const toml::node& node, std::string_view key) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) fail(key, "expected a finite number");
    return *value;
  }

  const toml::table& table_;
  std::string path_;
  std::string_view file_;
};

template <typename Entries>
std::string names_of(const Entries& entries) {
  std::vector<std::string_view> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

PlannedRun read_run(const Entry& entry) {
  entry.allow_only({"id", "case", "set"});
  PlannedRun run;
  run.id = entry.text("id");
  run.case_name = entry.has("case") ? entry.text("case") : run.id;
  if (entry.has("set")) run.set = entry.texts("set");
  for (const std::string& assignment : run.set)
    if (assignment.find('=') == std::string::npos)
      entry.fail("set", fmt::format("'{}' given; expected key=value", assignment));
  return run;
}

Parameters read_parameters(const Entry& check, const MetricEntry& metric) {
  Parameters parameters;
  const auto need = [&](bool needed, std::string_view key) {
    if (needed && !check.has(key))
      check.fail("metric", fmt::format("{} needs the key '{}'", metric.name, key));
    if (!needed && check.has(key)) check.fail(key, fmt::format("{} takes no such parameter", metric.name));
    return needed;
  };
  if (need(metric.needs.window, "window")) parameters.window = check.window("window");
  if (need(metric.needs.at, "at")) parameters.at = check.number("at");
  if (need(metric.needs.quiet, "quiet")) parameters.quiet = check.non_negative("quiet");
  if (need(metric.needs.level, "level")) parameters.level = check.number("level");
  if (need(metric.needs.published, "published")) parameters.published = check.text("published");
  if (need(metric.needs.published, "column")) parameters.column = check.text("column");
  if (need(metric.needs.against, "against")) parameters.against = check.text("against");
  return parameters;
}

Reference read_reference(const Entry& entry, const MetricEntry& metric) {
  entry.allow_only({"kind", "source", "value", "formula", "record", "band"});
  Reference reference;
  reference.kind = entry.one_of("kind", {ReferenceKind::theory, ReferenceKind::published, ReferenceKind::dem,
                                         ReferenceKind::regression});
  const int given = int{entry.has("value")} + int{entry.has("formula")} + int{entry.has("record")};
  if (given != 1) entry.fail("", "give exactly one of 'value', 'formula' and 'record'");
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
    reference.source = fmt::format("reference/results/{}", *reference.record);
  }
  if (entry.has("source"))
    reference.source = entry.text("source");
  else if (reference.source.empty())
    entry.fail("", "the key 'source' is missing: where does the value come from?");
  if (entry.has("band")) reference.band = entry.non_negative("band");
  return reference;
}

Tolerance read_tolerance(const Entry& entry, const MetricEntry& metric) {
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

std::vector<Check> read_check(const Entry& entry) {
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
  check.reference = read_reference(entry.entry("reference"), *metric);
  check.tolerance = read_tolerance(entry.entry("tolerance"), *metric);
  if (entry.has("relation"))
    check.relation = entry.one_of("relation", {Relation::equal, Relation::at_most, Relation::at_least});
  if (entry.has("asserted")) check.asserted = entry.truth("asserted");
  check.frequency = entry.one_of(
      "frequency", {Frequency::short_, Frequency::verify, Frequency::nightly, Frequency::weekly});
  if (entry.has("expected_failure")) {
    const Entry failure = entry.entry("expected_failure");
    failure.allow_only({"reason", "distance"});
    check.expected_failure = {failure.text("reason"), failure.non_negative("distance")};
    if (!check.asserted) entry.fail("expected_failure", "a row that is not asserted cannot fail");
  }
  if (entry.has("label")) check.label = entry.text("label");
  std::vector<Check> checks;
  for (const std::string& run : entry.texts("run")) {
    check.run = run;
    check.id = id_of(check);
    checks.push_back(check);
  }
  return checks;
}

const toml::array* rows_of(const toml::table& root, std::string_view key, std::string_view name) {
  const toml::node* node = root.get(key);
  if (!node) return nullptr;
  const toml::array* rows = node->as_array();
  if (!rows || !rows->is_array_of_tables())
    throw TableError(
        fmt::format("{}:{}: {}: expected [[{}]] entries", name, node->source().begin.line, key, key));
  return rows;
}

Table read_root(const toml::table& root, std::string_view name) {
  const Entry top(root, "table", name);
  top.allow_only({"run", "check"});
  Table table;
  std::set<std::string> runs, checks;
  if (const toml::array* rows = rows_of(root, "run", name))
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const Entry entry(*rows->get(i)->as_table(), fmt::format("run[{}]", i + 1), name);
      table.runs.push_back(read_run(entry));
      if (!runs.insert(table.runs.back().id).second)
        entry.fail("id", fmt::format("'{}' is given twice", table.runs.back().id));
    }
  const auto require_run = [&](const Entry& entry, std::string_view key, const std::string& run) {
    if (!runs.contains(run))
      entry.fail(key, fmt::format("no [[run]] has the id '{}'; there are: {}", run, fmt::join(runs, ", ")));
  };
  if (const toml::array* rows = rows_of(root, "check", name))
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const Entry entry(*rows->get(i)->as_table(), fmt::format("check[{}]", i + 1), name);
      for (Check& check : read_check(entry)) {
        require_run(entry, "run", check.run);
        if (check.parameters.against) require_run(entry, "against", *check.parameters.against);
        if (!checks.insert(check.id).second)
          entry.fail("", fmt::format("'{}' is checked twice; give the second a 'label'", check.id));
        table.checks.push_back(std::move(check));
      }
    }
  return table;
}

}  // namespace

Table parse_table(std::string_view text, std::string_view name) {
  try {
    return read_root(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw TableError(fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

Table read_table(const std::filesystem::path& file) {
  try {
    return read_root(toml::parse_file(file.string()), file.string());
  } catch (const toml::parse_error& error) {
    throw TableError(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
}

}  // namespace granvof::compare
