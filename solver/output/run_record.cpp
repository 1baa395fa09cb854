#include "solver/output/run_record.hpp"

#include <chrono>
#include <cmath>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solver/output/atomic_file.hpp"
#include "solver/output/build_info.hpp"
#include "solver/output/host_facts.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/seal.hpp"
#include "solver/plausibility/plausibility.hpp"

namespace granvof {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view format_name = "granvof run";

std::string_view exit_state_name(ExitState state) {
  switch (state) {
    case ExitState::running:
      return "running";
    case ExitState::finished:
      return "finished";
    case ExitState::failed:
      return "failed";
    case ExitState::stopped:
      return "stopped";
  }
  return "";
}

// JSON has no word for what is not a number.
double figure_of(const ordered_json& value) {
  return value.is_null() ? std::nan("") : value.get<double>();
}

// "running" and "finished" are their own kind.
std::string_view kind_of(const RunExit& exit) {
  if (exit.state == ExitState::failed) return name_of(exit.kind.value_or(ExitKind::error));
  if (exit.state == ExitState::stopped) return name_of(exit.kind.value_or(ExitKind::signal));
  return exit_state_name(exit.state);
}

ordered_json resumption_json(const Resumption& resumption) {
  ordered_json changes = ordered_json::array();
  for (const CaseChange& change : resumption.changes)
    changes.push_back({{"key", change.key}, {"was", change.was}, {"is", change.is}});
  return {{"date", resumption.date},
          {"time", resumption.time},
          {"threads", resumption.threads},
          {"changes", changes}};
}

Resumption resumption_of(const ordered_json& json) {
  Resumption resumption{json.at("date"), json.at("time"), json.value("threads", 1), {}};
  for (const auto& change : json.value("changes", ordered_json::array()))
    resumption.changes.push_back({change.at("key"), change.at("was"), change.at("is")});
  return resumption;
}

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json files_json(const FilesWritten& files) {
  return {{"series.csv",
           {{"rows", files.series.rows},
            {"end", or_null(files.series.end)},
            {"columns", files.series.columns},
            {"sha256", files.series.sha256}}},
          {"fields.h5",
           {{"instants", files.instants},
            {"sha256", files.fields_sha256.empty() ? ordered_json() : ordered_json(files.fields_sha256)}}}};
}

ordered_json ledger_json(const std::vector<LedgerTerm>& ledger) {
  ordered_json terms = ordered_json::array();
  for (const LedgerTerm& term : ledger) {
    terms.push_back({{"name", term.name},
                     {"part", term.part},
                     {"kind", term.kind},
                     {"sign", term.sign},
                     {"never_gains", term.never_gains},
                     {"label", term.label},
                     {"meaning", term.meaning},
                     {"measured_in", term.measured_in}});
  }
  return terms;
}

ordered_json host_json() {
  const auto host = host_facts();
  const auto& build = build_info();
  return {{"cpu_model", host.cpu_model},       {"cores", host.cores},
          {"memory_bytes", host.memory_bytes}, {"operating_system", host.operating_system},
          {"compiler", build.compiler},        {"flags", build.flags},
          {"build_type", build.build_type}};
}

// Paths and arguments may hold any bytes; what is not UTF-8 is replaced.
std::string text_of(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string run_record_text(const Scene& scene, const RunRecord& record, const RunProgress& progress,
                            const FilesWritten& files, const RunExit& exit) {
  const auto& build = build_info();
  ordered_json json;
  json["format"] = format_name;
  json["contract_version"] = output_contract_version;
  json["program"] = record.start.program;
  json["scene"] = scene.name;
  json["title"] = scene.title;
  json["case_hash"] = scene.hash;
  json["version"] = build.version;
  json["git_commit"] = build.git_commit.empty() ? ordered_json() : ordered_json(build.git_commit);
  json["command"] = record.start.command;
  json["start_date"] = record.start_date;
  json["resumptions"] = ordered_json::array();
  for (const Resumption& resumption : record.resumptions)
    json["resumptions"].push_back(resumption_json(resumption));
  json["ranks"] = record.start.ranks;
  json["threads"] = record.start.threads;
  json["cells"] = progress.cells;
  json["grid"] = {{"cells", scene.grid.cells}, {"spacing", scene.grid.spacing}};
  json["steps"] = progress.steps;
  json["refused_steps"] = progress.refused_steps;
  json["simulated_time"] = progress.simulated_time;
  json["wall_seconds"] = progress.wall_seconds;
  json["core_seconds"] = progress.core_seconds;
  const double cell_steps = static_cast<double>(progress.cells) * static_cast<double>(progress.steps);
  json["cell_steps_per_second"] =
      progress.wall_seconds > 0.0 ? ordered_json(cell_steps / progress.wall_seconds) : ordered_json();
  json["cost"] = progress.cost;
  json["solid_volume_error"] = progress.solid_volume_error;
  json["liquid_volume_error"] = progress.liquid_volume_error;
  json["solid_fraction_max"] = progress.solid_fraction_max;
  json["monitors"] = progress.monitors;
  if (!record.start.ledger.empty()) json["ledger"] = ledger_json(record.start.ledger);
  for (const Part* part : record.start.parts)
    json["parts"].push_back(
        {{"name", part->name}, {"equations", text_of_equations(part->equations)}, {"page", part->page}});
  json["warnings"] = ordered_json::array();
  for (const Warning& w : progress.warnings) {
    json["warnings"].push_back({{"monitor", w.monitor},
                                {"time", w.time},
                                {"value", w.value},
                                {"limit", w.limit},
                                {"meaning", w.meaning}});
  }
  json["plausibility"] = ordered_json::array();
  for (const Implausible& i : plausibility(scene)) {
    json["plausibility"].push_back(
        {{"key", i.key}, {"given", i.given}, {"usual", i.usual}, {"reason", i.reason}});
  }
  json["files"] = files_json(files);
  json["exit"] = {{"state", exit_state_name(exit.state)},
                  {"kind", kind_of(exit)},
                  {"reason", exit.reason},
                  {"time", progress.simulated_time},
                  {"date", iso_date_now()},
                  {"resume_from", or_null(files.checkpoint)}};
  json["host"] = host_json();
  json["resolved_case"] = scene.resolved;
  return sealed(text_of(json));
}

std::optional<std::string> ended_record_text(const std::string& run_json, const RunExit& exit) {
  auto json = ordered_json::parse(run_json, nullptr, false);
  if (seal_of(run_json) != Seal::whole || !json.is_object() || !json.contains("exit")) return std::nullopt;
  ordered_json& end = json["exit"];
  if (end.value("state", "") != exit_state_name(ExitState::running)) return std::nullopt;
  end["state"] = exit_state_name(exit.state);
  end["kind"] = kind_of(exit);
  end["reason"] = exit.reason;
  end["date"] = iso_date_now();
  json.erase("sha256");
  return sealed(text_of(json));
}

std::optional<ExistingRun> read_existing_run(const std::filesystem::path& run_json) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(run_json, none)) return std::nullopt;
  const std::string text = read_file(run_json);
  const auto json = ordered_json::parse(text, nullptr, false);
  try {
    if (json.is_discarded() || json.at("format") != format_name) return std::nullopt;
    require_seal(text, json.contains("sha256"), run_json);
    ExistingRun run;
    run.program = json.at("program");
    run.version = json.at("version");
    run.scene = json.at("scene");
    run.case_hash = json.at("case_hash");
    run.resolved_case = json.at("resolved_case");
    run.record.start_date = json.at("start_date");
    for (const auto& entry : json.at("resumptions")) run.record.resumptions.push_back(resumption_of(entry));
    for (const auto& w : json.value("warnings", ordered_json::array()))
      run.warnings.push_back(
          {w.at("monitor"), w.at("time"), figure_of(w.at("value")), w.at("limit"), w.at("meaning")});
    run.has_checkpoint = !json.at("exit").value("resume_from", ordered_json()).is_null();
    run.time = json.at("exit").value("time", 0.0);
    const ordered_json& series = json.at("files").at("series.csv");
    run.series.rows = series.at("rows");
    run.series.sha256 = series.at("sha256");
    return run;
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
}

std::string_view name_of(ExitKind kind) {
  switch (kind) {
    case ExitKind::step_collapse:
      return "step collapse";
    case ExitKind::not_finite:
      return "not finite";
    case ExitKind::alarm:
      return "alarm";
    case ExitKind::output:
      return "output";
    case ExitKind::error:
      return "error";
    case ExitKind::signal:
      return "signal";
    case ExitKind::cpu_limit:
      return "CPU limit";
    case ExitKind::wall_clock_limit:
      return "wall-clock limit";
  }
  return "";
}

std::string iso_date_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

}  // namespace granvof
