#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "compare/output/write.hpp"
#include "compare/study/ablate.hpp"

namespace granvof::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string state_of(const Ablation& row, const AblateReport& report) {
  if (!row.applies) return "does not apply: " + row.failure;
  if (!row.failure.empty()) return "FAILED: " + row.failure;
  if (row.dispensable()) return "no metric beyond its tolerance";
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < row.effects.size(); ++i)
    if (row.effects[i].beyond) changed.push_back(metric_label(report.metrics[i].check));
  return fmt::format("changes {}", fmt::join(changed, ", "));
}

// Of a column of the table.
std::size_t width_of(const Ablation& row) {
  return std::max<std::size_t>(17, row.name.size());
}

}  // namespace

std::string ablate_text(const AblateReport& report) {
  const Ablation& full = report.rows.front();
  std::string text = fmt::format("{} {}: each part of the model removed, put in or changed in turn ({})\n",
                                 report.scene, fmt::join(report.set, " "), report.version);
  text += fmt::format("  {:<26} {:>12} {:>12} {:>10} {:<6}", "metric", "reference", "full model", "tolerance",
                      "unit");
  for (std::size_t n = 1; n < report.rows.size(); ++n)
    if (report.rows[n].applies) text += fmt::format(" {:>{}}", report.rows[n].name, width_of(report.rows[n]));
  for (std::size_t i = 0; i < report.metrics.size(); ++i) {
    const AblatedMetric& metric = report.metrics[i];
    const auto number = [](const std::optional<double>& v) { return v ? fmt::format("{:.5g}", *v) : "-"; };
    text +=
        fmt::format("\n  {:<26} {:>12} {:>12} {:>10.3g} {:<6}", metric_label(metric.check),
                    number(metric.reference), number(metric.full), full.effects[i].tolerance, metric.unit);
    for (std::size_t n = 1; n < report.rows.size(); ++n) {
      const Ablation& row = report.rows[n];
      if (!row.applies) continue;
      std::string cell = "failed";
      if (!row.effects.empty())
        cell = row.effects[i].change ? fmt::format("{:+.3g}", *row.effects[i].change) : "-";
      if (!row.effects.empty() && row.effects[i].beyond) cell += " *";
      text += fmt::format(" {:>{}}", cell, width_of(row));
    }
  }
  text +=
      fmt::format("\n  {:<26} {:>12} {:>12.4g} {:>10} {:<6}", "cost", "", full.core_seconds, "", "core-s");
  for (std::size_t n = 1; n < report.rows.size(); ++n)
    if (report.rows[n].applies)
      text += fmt::format(
          " {:>{}}",
          full.cost > 0.0 ? fmt::format("{:+.0f} %", 100.0 * (report.rows[n].cost / full.cost - 1.0)) : "-",
          width_of(report.rows[n]));
  text += "\n  * beyond the tolerance; changes are against the full model\n";
  for (std::size_t n = 1; n < report.rows.size(); ++n)
    text += fmt::format("  {:<18} {}\n", report.rows[n].name, state_of(report.rows[n], report));
  return text;
}

std::string ablate_csv(const AblateReport& report) {
  const auto quoted = [](const std::string& text) {
    std::string safe = "\"";
    for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
    return safe + "\"";
  };
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
  };
  std::string text =
      "part,metric,value,change,unit,tolerance,beyond,core_seconds,core_s_per_s,work_units_per_s,failure\n";
  for (const Ablation& row : report.rows)
    for (std::size_t i = 0; i < report.metrics.size(); ++i) {
      const Effect effect = row.effects.empty() ? Effect{} : row.effects[i];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", quoted(row.name),
                          quoted(metric_label(report.metrics[i].check)), number(effect.value),
                          number(effect.change), report.metrics[i].unit, effect.tolerance,
                          row.effects.empty() ? "" : (effect.beyond ? "yes" : "no"), row.core_seconds,
                          row.cost, row.work, quoted(row.failure));
    }
  return text;
}

std::string ablate_json(const AblateReport& report) {
  Json json{{"scene", report.scene},         {"set", report.set},   {"version", report.version},
            {"case_hash", report.case_hash}, {"host", report.host}, {"metrics", Json::array()},
            {"rows", Json::array()}};
  for (const AblatedMetric& metric : report.metrics)
    json["metrics"].push_back({{"metric", metric_label(metric.check)},
                               {"unit", metric.unit},
                               {"tolerance", tolerance_text(metric.check)},
                               {"full", json_number(metric.full)},
                               {"reference", json_number(metric.reference)}});
  for (const Ablation& row : report.rows) {
    Json effects = Json::array();
    for (const Effect& effect : row.effects)
      effects.push_back({{"value", json_number(effect.value)},
                         {"change", json_number(effect.change)},
                         {"tolerance", effect.tolerance},
                         {"beyond", effect.beyond}});
    json["rows"].push_back({{"part", row.name},
                            {"set", row.set},
                            {"about", row.about},
                            {"applies", row.applies},
                            {"failure", row.failure},
                            {"dispensable", row.dispensable()},
                            {"core_seconds", row.core_seconds},
                            {"core_s_per_s", row.cost},
                            {"work_units_per_s", row.work},
                            {"effects", effects}});
  }
  return json.dump(1) + "\n";
}

}  // namespace granvof::compare
