// Error against cost: every method of the study on every grid of a chart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/study/pareto.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/study_file.hpp"
#include "compare/study/target.hpp"

namespace granvof::compare {

// One run: a method on a grid.
struct ChartPoint {
  std::string method;
  double cell = 0.0;  // [m]
  std::vector<std::string> set;
  bool other_model = false;
  std::string failure;  // empty where it finished
  std::string version, case_hash, host;
  double core_seconds = 0.0;
  double cost = 0.0;  // [core-s per simulated s]
  double work = 0.0;  // work units per simulated second
};

// What others made of the case, as it is recorded.
struct OtherPoint {
  std::string name, source, about, line;
  double cost = 0.0;  // [core-s per simulated s]
};

// What one panel shows of these runs; `errors` in their order.
struct PanelResult {
  Panel panel;
  Target target;
  std::vector<std::optional<double>> errors;  // nothing: failed, undefined, or the reference itself
  // Of the others, in their order; nothing also against our own finest grid, and where they are the
  // reference.
  std::vector<std::optional<double>> other_errors;
  std::vector<std::size_t> front;  // Pareto among our own runs, ascending in cost
};

struct ChartResult {
  Chart chart;
  std::vector<ChartPoint> points;
  std::vector<OtherPoint> others;     // of the study's, those that there is a record of
  std::vector<std::string> left_out;  // "second order on 0.625 mm (too dear)"
  std::vector<PanelResult> panels;
  std::optional<double> dem_cost;  // [core-s per simulated s], from the records of the case
};

// Runs what is missing. Throws CaseError for a case that cannot be read; a run that fails is a point.
ChartResult make_chart(const Chart& chart, const Study& study, const std::filesystem::path& cases,
                       const std::filesystem::path& records, Runner& runner);

// One line a panel: "for 10 % / 5 % / 2 % use this, it costs that, DEM-VOF costs so many times more". What
// meets a tolerance on a grid and misses it, or fails, on a finer one has met it by accident, and is not
// named.
std::vector<std::string> recommendations(const ChartResult& result);

std::string charts_text(const std::vector<ChartResult>& results);
// Columns:
// case,method,cell_m,quantity,against,error,floor,pareto,core_seconds,core_s_per_s,work_units_per_s,failure.
std::string charts_csv(const std::vector<ChartResult>& results);
std::string charts_json(const std::vector<ChartResult>& results, const Study& study, const std::string& date);

}  // namespace granvof::compare
