#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "compare/study/advise_scene.hpp"
#include "compare/study/answer.hpp"

namespace granvof::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json answer_json(const AdviseReport& report) {
  const auto answer = answer_of(report);
  if (!answer) return nullptr;
  return {{"confirmed", answer->confirmed},
          {"value", answer->value},
          {"unit", report.input.quantity.unit()},
          {"end_of_curve", json_number(answer->end)},
          {"by_grid", json_number(answer->by_grid)},
          {"by_model", json_number(answer->by_model)},
          {"by_model_and_grid", json_number(answer->by_both)}};
}

Json presets_json(const AdviseReport& report) {
  Json list = Json::array();
  const auto add = [&](const OtherModel& one) {
    list.push_back({{"method", one.method},
                    {"preset", one.preset},
                    {"value", json_number(one.value)},
                    {"distance", json_number(one.distance)},
                    {"core_s_per_s", one.cost},
                    {"failure", one.failure}});
  };
  if (report.others.empty()) return list;
  add(report.itself);
  for (const OtherModel& other : report.others) add(other);
  return list;
}

std::string error_text(const Trial& trial) {
  return trial.error ? fmt::format("{:.2g} %", 100.0 * *trial.error) : "-";
}

// What kind of error the figure is: what a reader must know before the figure.
std::string meaning_of(const Target& target) {
  if (target.kind == kind_of_own)
    return "what the figure is: GRID ERROR ONLY, against our own finest grid; the scene has no record, and "
           "whether the "
           "model is right this does not tell";
  if (target.kind == "DEM")
    return "what the figure is: error of model and grid together, against DEM-VOF of this scene";
  return fmt::format("what the figure is: error of model and grid together, against {}",
                     target.kind == "theory" ? "theory" : "a published series");
}

std::vector<std::string> other_models(const AdviseReport& report) {
  if (report.others.empty()) return {};
  std::string line =
      fmt::format("presets: {} on {:.4g} mm; beside it", report.model, 1e3 * report.others_cell);
  double farthest = 0.0;
  for (const OtherModel& other : report.others) {
    farthest = std::max(farthest, other.distance.value_or(0.0));
    line += fmt::format("{} {} {}", &other == &report.others.front() ? "" : ",", other.method,
                        other.distance          ? fmt::format("{:.2g} % off", 100.0 * *other.distance)
                        : other.failure.empty() ? "not comparable"
                                                : other.failure);
  }
  std::vector<std::string> lines{line};
  if (farthest > report.input.tolerance)
    lines.push_back(
        fmt::format("WARNING: the choice of the preset moves it by {:.2g} %, more than the tolerance, which "
                    "holds for the grid alone",
                    100.0 * farthest));
  return lines;
}

// A comment of lines of at most 120 characters, broken between words; what goes on is indented.
std::string comment(const std::string& text, const std::string& indent = "") {
  constexpr std::size_t width = 120;
  std::string lines, line = indent.empty() ? "#" : fmt::format("# {}", indent);
  bool empty = true;
  std::istringstream words(text);
  for (std::string word; words >> word; empty = false) {
    if (!empty && line.size() + 1 + word.size() > width) {
      lines += fmt::format("{}\n", line);
      line = fmt::format("#   {}", indent);
    }
    line += fmt::format(" {}", word);
  }
  return fmt::format("{}{}\n", lines, line);
}

// "numerics.solid_flux=limited" -> "solid_flux = \"limited\"": a bare word becomes a text, as --set takes it.
std::string toml_line(const std::string& key, const std::string& value) {
  const bool literal = value == "true" || value == "false" || value.find_first_of("0123456789[{\"'+-") == 0;
  return literal ? fmt::format("{} = {}\n", key, value) : fmt::format("{} = \"{}\"\n", key, value);
}

}  // namespace

std::vector<std::string> advise_summary(const AdviseReport& report) {
  const Target& target = report.target;
  const bool grid_only = target.kind == kind_of_own;
  std::vector<std::string> lines{fmt::format("{}: {} to {:g} %", report.scene, report.input.quantity.label(),
                                             100.0 * report.input.tolerance),
                                 meaning_of(target)};
  if (const auto answer = answer_of(report)) lines.push_back(answer_text(report, *answer));
  if (grid_only)
    for (const std::string& line : likeness_text(report.numbers, report.input.like)) lines.push_back(line);
  for (const std::string& line : other_models(report)) lines.push_back(line);
  lines.push_back(fmt::format("reference: {}, {}; its own uncertainty {:.2g} %{}", target.kind, target.source,
                              100.0 * target.floor, target.note.empty() ? "" : "; " + target.note));
  if (!report.refusal.empty()) {
    lines.push_back(report.refusal);
    return lines;
  }
  if (!report.advice.chosen) {
    lines.emplace_back("no configuration meets it and is confirmed by a finer run");
    return lines;
  }
  const Step& chosen = *report.advice.chosen;
  const char* error = grid_only ? "grid error" : "error";
  lines.push_back(fmt::format("cheapest: {}; {} {}, {:.3g} core-s per simulated s",
                              name_of(chosen.configuration), error, error_text(chosen.trial),
                              chosen.trial.cost));
  if (target.cost)
    lines.push_back(fmt::format("DEM-VOF costs {:.0f} times that", *target.cost / chosen.trial.cost));
  const Step& finer = *report.advice.confirmation;
  lines.push_back(fmt::format("confirmed by {}: {} {}, {:.2g} % from it", name_of(finer.configuration), error,
                              error_text(finer.trial), 100.0 * *report.advice.moved));
  return lines;
}

std::string advise_text(const AdviseReport& report) {
  std::string text;
  for (const std::string& line : advise_summary(report)) text += line + "\n";
  for (const std::string& line : presets_table(report)) text += line + "\n";
  if (!report.advice.steps.empty()) text += "evidence:\n";
  for (const Step& step : report.advice.steps)
    text += fmt::format("  {:<60} {:>8} {:>9.3g} core-s/s  {}\n", name_of(step.configuration),
                        error_text(step.trial), step.trial.cost, step.remark);
  return text;
}

std::string advise_json(const AdviseReport& report) {
  Json json{
      {"scene", report.scene},
      {"quantity", report.input.quantity.label()},
      {"tolerance", report.input.tolerance},
      {"answer", answer_json(report)},
      {"reference",
       {{"kind", report.target.kind}, {"source", report.target.source}, {"floor", report.target.floor}}},
      {"version", report.version},
      {"summary", advise_summary(report)},
      {"refusal", report.refusal},
      {"set", report.set},
      {"presets", presets_json(report)},
      {"steps", Json::array()}};
  for (const Step& step : report.advice.steps)
    json["steps"].push_back({{"configuration", name_of(step.configuration)},
                             {"error", json_number(step.trial.error)},
                             {"core_s_per_s", step.trial.cost},
                             {"remark", step.remark}});
  return json.dump(1) + "\n";
}

std::string advised_case(const AdviseReport& report, const std::filesystem::path& directory,
                         const std::string& name) {
  std::string text = comment(fmt::format(
      "{}: {} as cheap as {} to {:g} % allows; by granvof-compare advise, {}.", name, report.scene,
      report.input.quantity.label(), 100.0 * report.input.tolerance, report.version));
  text += "#\n";
  for (const std::string& line : advise_summary(report)) text += comment(line);
  if (!report.others.empty()) text += "#\n";
  for (const std::string& line : presets_table(report)) text += fmt::format("# {}\n", line);
  text += "#\n# Evidence (error, core-s per simulated s):\n";
  for (const Step& step : report.advice.steps)
    text += comment(fmt::format("{}: {}, {:.3g}; {}", name_of(step.configuration), error_text(step.trial),
                                step.trial.cost, step.remark),
                    " ");
  // The last of two overrides of one key holds, as on the command line.
  std::map<std::string, std::map<std::string, std::string>> tables;
  for (const std::string& assignment : report.set) {
    const auto equals = assignment.find('=');
    const std::string key = assignment.substr(0, equals);
    const auto dot = key.find('.');
    tables[key.substr(0, dot)][key.substr(dot + 1)] = assignment.substr(equals + 1);
  }
  tables["scene"]["name"] = name;
  const auto base = std::filesystem::relative(report.input.case_file, directory);
  text += fmt::format("base = \"{}\"\n", base.generic_string());
  for (const auto& [table, keys] : tables) {
    text += fmt::format("\n[{}]\n", table);
    for (const auto& [key, value] : keys) text += toml_line(key, value);
  }
  return text;
}

}  // namespace granvof::compare
