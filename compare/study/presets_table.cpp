#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "compare/study/advise_scene.hpp"

namespace granvof::compare {
namespace {

std::string short_name(const OtherModel& one) {
  return one.preset.empty() ? one.method : one.preset;
}

// Of one run, or of several of a preset in a scene the smallest and the largest.
std::string known_error(const LikeScene& scene, const std::string& preset) {
  std::optional<double> lowest, highest;
  for (const ModelError& error : scene.errors)
    if (error.preset == preset) {
      lowest = std::min(lowest.value_or(error.lowest), error.lowest);
      highest = std::max(highest.value_or(error.highest), error.highest);
    }
  if (!highest) return "not known";
  if (*lowest == *highest) return fmt::format("{:.0f} %", 100.0 * *highest);
  return fmt::format("{:.0f} to {:.0f} %", 100.0 * *lowest, 100.0 * *highest);
}

std::string percent_off(const OtherModel& one) {
  if (one.distance) return fmt::format("{:.2g} %", 100.0 * *one.distance);
  return one.failure.empty() ? "not comparable" : "failed";
}

}  // namespace

std::vector<std::string> presets_table(const AdviseReport& report) {
  if (report.others.empty()) return {};
  std::vector<OtherModel> columns{report.itself};
  columns.insert(columns.end(), report.others.begin(), report.others.end());
  const bool has_values =
      std::ranges::any_of(columns, [](const OtherModel& one) { return one.value.has_value(); });

  std::vector<std::vector<std::string>> rows;
  const auto add = [&](std::string title, const std::function<std::string(const OtherModel&)>& cell) {
    rows.push_back({std::move(title)});
    for (const OtherModel& one : columns) rows.back().push_back(cell(one));
  };
  add(fmt::format("presets on {:.4g} mm", 1e3 * report.others_cell), short_name);
  if (has_values)
    add(fmt::format("{} [{}]", report.input.quantity.label(), report.input.quantity.unit()),
        [](const OtherModel& one) { return one.value ? fmt::format("{:.3g}", *one.value) : "-"; });
  add(fmt::format("off from {}", short_name(columns.front())),
      [&](const OtherModel& one) { return &one == &columns.front() ? std::string("-") : percent_off(one); });
  if (!report.input.like.empty()) {
    const LikeScene& scene = report.input.like.front();
    add(fmt::format("off in {}, against {}{}", scene.case_name, scene.errors.front().kind,
                    scene.farthest <= near_factor ? "" : " (not near)"),
        [&](const OtherModel& one) { return known_error(scene, one.preset); });
  }
  add("core-s per simulated s", [](const OtherModel& one) {
    return one.failure.empty() ? fmt::format("{:.3g}", one.cost) : std::string("-");
  });

  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string line = fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace granvof::compare
