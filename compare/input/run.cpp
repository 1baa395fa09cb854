#include "compare/input/run.hpp"

#include <cmath>
#include <exception>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/input/is_there.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/json_fault.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/seal.hpp"
#include "solver/scene/printable.hpp"

namespace granvof::compare {
namespace {

std::string text_of(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

template <typename Value>
std::optional<Value> value_or_null(const nlohmann::json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<Value>());
}

StatedFiles stated_files(const nlohmann::json& json) {
  const auto& series = json.at("series.csv");
  StatedFiles files{
      {series.at("rows"), value_or_null<double>(series.at("end")), series.at("columns"), series.at("sha256")},
      std::nullopt};
  if (const auto fields = json.find("fields.h5"); fields != json.end())
    files.fields = StatedFields{fields->at("instants"), value_or_null<std::string>(fields->at("sha256"))};
  return files;
}

std::vector<LedgerTerm> ledger_of(const nlohmann::json& json) {
  std::vector<LedgerTerm> ledger;
  for (const auto& term : json)
    ledger.push_back({term.at("name"), term.value("part", ""), term.at("kind"), term.at("sign"),
                      term.at("never_gains"), term.at("label"), term.at("meaning"), term.at("measured_in")});
  return ledger;
}

RunFacts facts_of(const nlohmann::json& json) {
  RunFacts facts;
  facts.scene = text_of(json, "scene");
  facts.version = text_of(json, "version");
  facts.case_hash = text_of(json, "case_hash");
  facts.resolved_case = text_of(json, "resolved_case");
  facts.commit = text_of(json, "git_commit");
  facts.date = text_of(json, "start_date");
  if (const auto exit = json.find("exit"); exit != json.end() && exit->is_object()) {
    facts.exit = text_of(*exit, "state");
    facts.reason = text_of(*exit, "reason");
    facts.kind = text_of(*exit, "kind");
    if (facts.kind.empty())
      facts.kind = facts.exit == "failed" ? "error" : facts.exit == "stopped" ? "signal" : facts.exit;
  }
  if (const auto host = json.find("host"); host != json.end() && host->is_object())
    facts.host = text_of(*host, "cpu_model");
  for (const auto& [key, value] : json.items())
    if (value.is_number()) facts.numbers[key] = value.get<double>();
  if (const auto monitors = json.find("monitors"); monitors != json.end() && monitors->is_object())
    for (const auto& [key, value] : monitors->items())
      if (value.is_number()) facts.numbers.emplace(key, value.get<double>());
  if (const auto ledger = json.find("ledger"); ledger != json.end()) facts.ledger = ledger_of(*ledger);
  if (const auto warnings = json.find("warnings"); warnings != json.end() && warnings->is_array())
    facts.numbers["warnings"] = static_cast<double>(warnings->size());
  if (const auto grid = json.find("grid"); grid != json.end() && grid->is_object())
    facts.grid = Grid3{grid->at("cells").get<std::array<int, 3>>(), grid->at("spacing").get<Vec3>()};
  if (const auto files = json.find("files"); files != json.end()) facts.files = stated_files(*files);
  return facts;
}

// A resolved case without its [reference] table, of which our own run reads nothing.
std::string without_reference(const std::string& resolved) {
  std::istringstream lines(resolved);
  std::string kept;
  bool skipping = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) skipping = line == "[reference]";
    if (!skipping && !line.empty()) kept += line + '\n';
  }
  return kept;
}

// "was '<line>', is '<line>'" of the first line in which two texts differ.
std::string first_difference(const std::string& before, const std::string& now) {
  std::istringstream old_lines(before), new_lines(now);
  std::string old_line, new_line;
  for (;;) {
    const bool more_old = static_cast<bool>(std::getline(old_lines, old_line));
    const bool more_new = static_cast<bool>(std::getline(new_lines, new_line));
    if (!more_old) old_line.clear();
    if (!more_new) new_line.clear();
    if (old_line != new_line || (!more_old && !more_new))
      return fmt::format("was '{}', is '{}'", old_line, new_line);
  }
}

}  // namespace

std::string_view name_of(RunState state) {
  switch (state) {
    case RunState::usable:
      return "usable";
    case RunState::missing:
      return "missing";
    case RunState::failed:
      return "failed";
    case RunState::refused:
      return "refused";
    case RunState::stale:
      return "stale";
  }
  return "refused";
}

std::optional<double> RunFacts::number(std::string_view name) const {
  const auto found = numbers.find(std::string(name));
  if (found == numbers.end()) return std::nullopt;
  return found->second;
}

RunFacts read_facts(const std::filesystem::path& json_file) {
  const std::string text = read_file(json_file);
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw OutputError("read", json_file, "it is not a JSON object");
  require_seal(text, json.contains("sha256"), json_file);
  try {
    RunFacts facts = facts_of(json);
    facts.sealed = seal_of(text) == Seal::whole;
    return facts;
  } catch (const nlohmann::json::exception& error) {
    throw OutputError("read", json_file, json_fault(error));
  }
}

Series read_evidence(const std::filesystem::path& directory, const RunFacts& facts, const Asked& asked) {
  if (!facts.files)
    throw OutputError("use", directory, "it was made by an earlier version, which did not say what it wrote");
  const auto file = directory / "series.csv";
  Series series = read_series(file);
  require_series(series, file, facts.files->series, asked);
  require_digest(file, facts.files->series.sha256);
  // Recorders write at the end of a step, which may come a little after what was asked.
  require_fields(directory, facts.files->fields, asked.end + interval_of(series, asked));
  return series;
}

Curve Run::curve(std::string_view column) const {
  Curve curve;
  if (interval > 0.0) curve.widest = widest_gap * interval;
  if (!series.has(column)) return curve;
  const auto time = series.column("time");
  const auto value = series.column(column);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!time[i] || !value[i]) continue;
    curve.time.push_back(*time[i]);
    curve.value.push_back(*value[i]);
  }
  return curve;
}

std::vector<double> Run::field_times() const {
  const auto file = directory / "fields.h5";
  return is_there(file) ? read_field_times(file) : std::vector<double>();
}

std::optional<CellFields> Run::solid_fraction_at(double time) const {
  const auto times = field_times();
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - time) <= 1e-6 * std::max(scene.times.end, std::abs(time)))
      return read_solid_fraction(directory / "fields.h5", i);
  return std::nullopt;
}

LoadedRun load_run(const std::filesystem::path& directory, std::string_view id, const Scene& scene) {
  LoadedRun loaded;
  loaded.directory = directory;
  try {
    if (!is_there(directory / "run.json")) {
      loaded.reason = fmt::format("no run in {}", directory.string());
      return loaded;
    }
    loaded.state = RunState::refused;
    loaded.facts = read_facts(directory / "run.json");
    if (loaded.facts->exit != "finished") {
      loaded.state = RunState::failed;
      loaded.reason = fmt::format("the run did not finish: {}{}", loaded.facts->exit,
                                  loaded.facts->reason.empty() ? "" : ", " + loaded.facts->reason);
      return loaded;
    }
    if (!loaded.facts->sealed)
      throw OutputError("use", directory / "run.json",
                        "it has no SHA-256 of itself: it was made by an earlier version, or changed");
    const std::string before = without_reference(loaded.facts->resolved_case);
    const std::string now = without_reference(scene.resolved);
    if (before != now) {
      loaded.state = RunState::stale;
      loaded.reason = "the case has changed since the run: " + first_difference(before, now);
      return loaded;
    }
    const auto& rows = scene.times.row_times;
    const Asked asked{rows.size() > 1 ? rows[1] - rows[0] : 0.0, scene.times.end,
                      static_cast<std::int64_t>(rows.size())};
    loaded.run =
        Run{std::string(id), directory, scene, *loaded.facts, read_evidence(directory, *loaded.facts, asked),
            asked.interval};
    loaded.state = RunState::usable;
  } catch (const std::exception& error) {
    loaded.run.reset();
    loaded.reason = fmt::format("refused: {}", case_file::printable(error.what(), longest_reason));
  }
  return loaded;
}

}  // namespace granvof::compare
