#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "compare/study/charts.hpp"

namespace granvof::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

bool on_front(const PanelResult& panel, std::size_t point) {
  return std::find(panel.front.begin(), panel.front.end(), point) != panel.front.end();
}

Json json_point(const ChartPoint& point) {
  return {{"method", point.method},     {"cell", point.cell},
          {"set", point.set},           {"failure", point.failure},
          {"version", point.version},   {"case_hash", point.case_hash},
          {"host", point.host},         {"core_seconds", point.core_seconds},
          {"core_s_per_s", point.cost}, {"work_units_per_s", point.work}};
}

Json json_panel(const PanelResult& panel) {
  Json json{{"quantity", panel.panel.quantity.label()},
            {"curve", panel.panel.quantity.is_curve},
            {"against", panel.target.kind},
            {"source", panel.target.source},
            {"defined", panel.target.observed.defined()},
            {"floor", panel.target.floor},
            {"note", panel.target.note},
            {"errors", Json::array()},
            {"other_errors", Json::array()},
            {"pareto", panel.front}};
  for (const auto& error : panel.errors) json["errors"].push_back(json_number(error));
  for (const auto& error : panel.other_errors) json["other_errors"].push_back(json_number(error));
  return json;
}

}  // namespace

std::string charts_text(const std::vector<ChartResult>& results) {
  std::string text;
  for (const ChartResult& result : results) {
    text += fmt::format("{}\n", result.chart.case_name);
    for (const PanelResult& panel : result.panels) {
      text += fmt::format("  {} against {} ({}), floor {:.2g} %{}\n", panel.panel.quantity.label(),
                          panel.target.kind, panel.target.source, 100.0 * panel.target.floor,
                          panel.target.note.empty() ? "" : "; " + panel.target.note);
      for (std::size_t i = 0; i < result.points.size(); ++i) {
        const ChartPoint& point = result.points[i];
        const std::string error = panel.errors[i] ? fmt::format("{:.3g} %", 100.0 * *panel.errors[i]) : "-";
        text += fmt::format("  {} {:<32} {:>9.4g} mm {:>10} {:>10.3g} core-s/s {:>9.3g} wu/s {}\n",
                            on_front(panel, i) ? "*" : " ", point.method, 1e3 * point.cell, error, point.cost,
                            point.work, point.failure.empty() ? "" : "FAILED: " + point.failure);
      }
      for (std::size_t i = 0; i < result.others.size(); ++i)
        if (panel.other_errors[i])
          text += fmt::format("    {:<45} {:>10} {:>10.3g} core-s/s\n", result.others[i].name,
                              fmt::format("{:.3g} %", 100.0 * *panel.other_errors[i]), result.others[i].cost);
    }
    for (const std::string& line : recommendations(result)) text += line + "\n";
    if (!result.left_out.empty()) text += fmt::format("left out: {}\n", fmt::join(result.left_out, ", "));
  }
  return text + "* Pareto front\n";
}

std::string charts_csv(const std::vector<ChartResult>& results) {
  std::string text =
      "case,method,cell_m,quantity,against,error,floor,pareto,core_seconds,core_s_per_s,work_units_per_s,"
      "failure\n";
  for (const ChartResult& result : results)
    for (const PanelResult& panel : result.panels)
      for (std::size_t i = 0; i < result.points.size(); ++i) {
        const ChartPoint& point = result.points[i];
        std::string failure = point.failure;
        std::replace(failure.begin(), failure.end(), '"', '\'');
        text += fmt::format("{},\"{}\",{:g},{},{},{},{},{},{},{},{},\"{}\"\n", result.chart.case_name,
                            point.method, point.cell, panel.panel.quantity.label(), panel.target.kind,
                            panel.errors[i] ? fmt::format("{}", *panel.errors[i]) : "", panel.target.floor,
                            on_front(panel, i) ? "yes" : "no", point.core_seconds, point.cost, point.work,
                            failure);
      }
  return text;
}

std::string charts_json(const std::vector<ChartResult>& results, const Study& study,
                        const std::string& date) {
  Json json{{"date", date}, {"methods", Json::array()}, {"charts", Json::array()}};
  for (const Method& method : study.methods)
    json["methods"].push_back({{"name", method.name}, {"set", method.set}, {"about", method.about}});
  for (const ChartResult& result : results) {
    Json chart{{"case", result.chart.case_name},
               {"left_out", result.left_out},
               {"dem_cost", json_number(result.dem_cost)},
               {"lines", recommendations(result)},
               {"points", Json::array()},
               {"others", Json::array()},
               {"panels", Json::array()}};
    for (const ChartPoint& point : result.points) chart["points"].push_back(json_point(point));
    for (const OtherPoint& other : result.others)
      chart["others"].push_back({{"name", other.name},
                                 {"source", other.source},
                                 {"about", other.about},
                                 {"line", other.line},
                                 {"core_s_per_s", other.cost}});
    for (const PanelResult& panel : result.panels) chart["panels"].push_back(json_panel(panel));
    json["charts"].push_back(std::move(chart));
  }
  return json.dump(1) + "\n";
}

}  // namespace granvof::compare
