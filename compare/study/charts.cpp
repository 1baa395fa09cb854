#include "compare/study/charts.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/input/records.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

constexpr std::array tolerances{0.10, 0.05, 0.02};

std::string cell_label(double cell) {
  return fmt::format("{:.4g} mm", 1e3 * cell);
}

bool is_reference_method(const Chart& chart, const Method& method) {
  return std::any_of(chart.panels.begin(), chart.panels.end(), [&](const Panel& panel) {
    return panel.against == Against::finest && panel.method == method.name;
  });
}

// The run of `method` on the n-th cell size from the smallest.
const Run* run_of(const ChartResult& result, const std::vector<Outcome>& outcomes, const std::string& method,
                  std::size_t from_finest) {
  const auto& grids = result.chart.grids;
  const double cell = grids[grids.size() - 1 - from_finest];
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (result.points[i].method == method && result.points[i].cell == cell && outcomes[i].run)
      return &*outcomes[i].run;
  return nullptr;
}

const Run* any_run(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes)
    if (outcome.run) return &*outcome.run;
  return nullptr;
}

Target target_of(const Panel& panel, const ChartResult& result, const std::vector<Outcome>& outcomes,
                 const Scene& scene, const std::filesystem::path& records) {
  const Run* some = any_run(outcomes);
  Target none{std::string(name_of(panel.against)), "", {}, 0.0, std::nullopt, "no run finished"};
  switch (panel.against) {
    case Against::finest: {
      const Run* finest = run_of(result, outcomes, panel.method, 0);
      if (finest)
        return own_target(panel.quantity, *finest, panel.method, run_of(result, outcomes, panel.method, 1));
      none.kind = kind_of_own;
      none.note = fmt::format("{} on {} did not finish", panel.method, cell_label(result.chart.grids.back()));
      return none;
    }
    case Against::dem:
      return dem_target(panel.quantity, scene, records, panel.record);
    case Against::theory:
      return some ? theory_target(*some, panel.formula) : none;
    case Against::published:
      return some ? published_target(*some, panel.published, panel.column) : none;
  }
  return none;
}

PanelResult judge_panel(const Panel& panel, const ChartResult& result, const std::vector<Outcome>& outcomes,
                        const Scene& scene, const std::filesystem::path& records) {
  PanelResult judged{panel, target_of(panel, result, outcomes, scene, records), {}, {}, {}};
  std::vector<WorkPrecision> points;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    std::optional<double> error;
    const ChartPoint& point = result.points[i];
    const bool itself = point.method == panel.method && point.cell == result.chart.grids.back();
    const bool held = panel.against != Against::finest || !(itself || point.other_model);
    if (outcomes[i].run && held)
      error = relative_distance(panel.quantity, observe(panel.quantity, *outcomes[i].run),
                                judged.target.observed);
    judged.errors.push_back(error);
    points.push_back({point.cost, error});
  }
  judged.front = pareto_front(points);
  return judged;
}

// A record of others with what a panel needs to judge it.
struct Recorded {
  const Other& other;
  Scene scene;
  std::filesystem::path directory;  // that holds CASE/
};

std::vector<Recorded> recorded(const Study& study, const Chart& chart, const std::filesystem::path& file,
                               const std::filesystem::path& records) {
  std::vector<Recorded> found;
  for (const Other& other : study.others) {
    const auto directory = other.records.empty() ? records : records / other.records;
    if (!std::filesystem::exists(directory / chart.case_name)) continue;
    std::vector<std::string> set = chart.set;
    set.insert(set.end(), other.set.begin(), other.set.end());
    found.push_back({other, load_scene(file, set), directory});
  }
  return found;
}

// Adds what the others made of the case to the panels.
void judge_others(ChartResult& result, const std::vector<Recorded>& all) {
  for (const Recorded& one : all) {
    std::optional<double> cost;
    std::vector<std::optional<double>> errors;
    for (const PanelResult& panel : result.panels) {
      const Quantity& quantity = panel.panel.quantity;
      const Target theirs = dem_target(quantity, one.scene, one.directory, result.chart.case_name);
      if (theirs.cost) cost = theirs.cost;
      const bool reference = panel.panel.against == Against::dem && one.other.records.empty();
      const bool held = panel.panel.against != Against::finest && !reference;
      errors.push_back(held ? relative_distance(quantity, theirs.observed, panel.target.observed)
                            : std::nullopt);
    }
    if (!cost) continue;
    result.others.push_back({one.other.name, one.other.records, one.other.about, one.other.line, *cost});
    if (one.other.records.empty()) result.dem_cost = cost;
    for (std::size_t i = 0; i < errors.size(); ++i) result.panels[i].other_errors.push_back(errors[i]);
  }
}

ChartPoint point_of(const Method& method, double cell, const std::vector<std::string>& set,
                    const Outcome& outcome) {
  ChartPoint point{
      method.name,          cell,           set,           method.other_model, outcome.failure, "", "", "",
      outcome.core_seconds, outcome.cost(), outcome.work()};
  if (!outcome.facts) return point;
  point.version = outcome.facts->version;
  if (!outcome.facts->commit.empty()) point.version += fmt::format(" ({})", outcome.facts->commit);
  point.case_hash = outcome.facts->case_hash;
  point.host = outcome.facts->host;
  return point;
}

bool stays_within(const ChartResult& result, const PanelResult& panel, std::size_t point, double tolerance) {
  const ChartPoint& one = result.points[point];
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const ChartPoint& other = result.points[i];
    if (other.method != one.method || other.cell >= one.cell) continue;
    if (!other.failure.empty() || panel.errors[i].value_or(0.0) > tolerance) return false;
  }
  return true;
}

std::string advice(const ChartResult& result, const PanelResult& panel, double tolerance) {
  if (panel.target.floor > tolerance)
    return fmt::format("nothing can be told (the reference itself is uncertain by {:.2g} %)",
                       100.0 * panel.target.floor);
  std::vector<WorkPrecision> points;
  points.reserve(result.points.size());
  for (std::size_t i = 0; i < result.points.size(); ++i)
    points.push_back(
        {result.points[i].cost, stays_within(result, panel, i, tolerance) ? panel.errors[i] : std::nullopt});
  const auto best = cheapest_within(points, tolerance);
  if (!best) return "none of these is enough";
  const ChartPoint& point = result.points[*best];
  std::string text = fmt::format("use {} on {} ({:.2g} core-s per s, {:.2g} work units", point.method,
                                 cell_label(point.cell), point.cost, point.work);
  if (result.dem_cost)
    text += fmt::format("; DEM-VOF costs {:.0f} times that", *result.dem_cost / point.cost);
  return text + ")";
}

}  // namespace

ChartResult make_chart(const Chart& chart, const Study& study, const std::filesystem::path& cases,
                       const std::filesystem::path& records, Runner& runner) {
  const auto file = cases / (chart.case_name + ".toml");
  const Scene scene = load_scene(file, chart.set);
  ChartResult result{chart, {}, {}, {}, {}, std::nullopt};
  std::vector<Outcome> outcomes;
  for (const Method& method : methods_of(study, &chart))
    for (std::size_t n = 0; n < chart.grids.size(); ++n) {
      const double cell = chart.grids[n];
      const bool too_dear = cell < chart.down_to * (1.0 - 1e-9) || n >= method.grids.value_or(n + 1);
      Job job{file, chart.set};
      job.set.push_back(fmt::format("grid.dx={:.12g}", cell));
      job.set.insert(job.set.end(), method.set.begin(), method.set.end());
      if (too_dear && !is_reference_method(chart, method) && !runner.has(job)) {
        result.left_out.push_back(fmt::format("{} on {} (too dear)", method.name, cell_label(cell)));
        continue;
      }
      Outcome outcome = runner.run(job);
      if (outcome.refused) {  // the case does not take this method or grid: nothing was run that could fail
        result.left_out.push_back(
            fmt::format("{} on {} ({})", method.name, cell_label(cell), outcome.failure));
        continue;
      }
      outcomes.push_back(std::move(outcome));
      result.points.push_back(point_of(method, cell, job.set, outcomes.back()));
    }
  for (const Panel& panel : chart.panels)
    result.panels.push_back(judge_panel(panel, result, outcomes, scene, records));
  judge_others(result, recorded(study, chart, file, records));
  return result;
}

std::vector<std::string> recommendations(const ChartResult& result) {
  std::vector<std::string> lines;
  for (const PanelResult& panel : result.panels) {
    std::string line = fmt::format("{}, {} against {} ({}): ", result.chart.case_name,
                                   panel.panel.quantity.label(), panel.target.kind, panel.target.source);
    if (!panel.target.observed.defined()) {
      lines.push_back(line + "no reference: " + panel.target.note);
      continue;
    }
    std::vector<std::string> parts;
    parts.reserve(tolerances.size());
    for (const double tolerance : tolerances)
      parts.push_back(fmt::format("for {:g} % {}", 100.0 * tolerance, advice(result, panel, tolerance)));
    line += fmt::format("{}", fmt::join(parts, "; "));
    if (!result.dem_cost) line += "; no DEM-VOF record to set the cost against";
    lines.push_back(line);
  }
  return lines;
}

}  // namespace granvof::compare
