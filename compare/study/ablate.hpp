// What each part of the model does to every metric of a scene, and to its cost.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/checks/check.hpp"
#include "compare/study/quantity.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/study_file.hpp"

namespace granvof::compare {

// A metric of the scene in the full model, and what it is held to.
struct AblatedMetric {
  Check check;  // the row of the table of checks that names the metric and its tolerance
  std::string unit;
  std::optional<double> full;
  std::optional<double> reference;  // the row's; of records their mean; none where the row only bounds
  // Of a curve: its value is how far the run's is from the full model's, relative [-]; that of the full model
  // is 0.
  std::optional<Quantity> curve = std::nullopt;
  Observed full_curve{};
};

// One metric without a part.
struct Effect {
  std::optional<double> value;
  std::optional<double> change;  // value - full, metric's unit
  double tolerance = 0.0;        // metric's unit
  // Beyond the tolerance; for a metric that is only bounded: another side of its bound; undefined counts too.
  bool beyond = false;
};

struct Ablation {
  std::string name;
  std::vector<std::string> set;
  std::string about;
  bool applies = true;          // false: the scene has no such form, `failure` says why
  std::string failure;          // of the run
  std::vector<Effect> effects;  // one a metric; empty where the run failed
  double cost = 0.0;            // [core-s per simulated s]
  double core_seconds = 0.0;
  double work = 0.0;  // work units per simulated second

  // It ran, and no metric changed beyond its tolerance.
  bool dispensable() const;
};

struct AblateReport {
  std::string scene, version, case_hash, host;
  std::vector<std::string> set;  // of all runs
  std::vector<AblatedMetric> metrics;
  std::vector<Ablation> rows;  // the first is the full model
};

// `parts` with each choice beside the paper's model (solver/scene/presets.cpp) as a part of its own: as
// another preset has it than the scene.
std::vector<Part> parts_for(const std::vector<Part>& parts, const Scene& scene);

// The overrides of a part for this scene. Throws std::invalid_argument where the scene has no such form.
std::vector<std::string> overrides_of(const Part& part, const Scene& scene);

// The metrics of a run by the table of checks, each with one tolerance; without cost, and without what needs
// a second run.
std::vector<Check> metrics_of_scene(const Table& table, const std::string& scene);

// What is to be looked at in any scene: the row of `rows` (metrics_of_scene()) where there is one of the same
// metric and instant, else the metric or curve with a tolerance relative to the full model's value (of a
// curve to its range).
Check check_of(const Quantity& quantity, double tolerance, const std::vector<Check>& rows);

// Runs the case with `set`, then with each of parts_for() removed or put in. References are taken from the
// rows, those recorded from `records`; `curves` are held against the full model's, with a tolerance relative
// to its range. Throws std::runtime_error where the full model does not run or there is nothing to look at.
AblateReport ablate(const std::filesystem::path& case_file, const std::vector<std::string>& set,
                    const std::vector<Part>& parts, const std::vector<Check>& checks,
                    const std::filesystem::path& records, Runner& runner,
                    const std::vector<Quantity>& curves = {}, double curve_tolerance = 0.0);

// The runs of that, the full model first.
std::vector<Job> jobs_of_ablation(const std::filesystem::path& case_file, const std::vector<std::string>& set,
                                  const std::vector<Part>& parts);

std::string ablate_text(const AblateReport& report);
// Columns: part,metric,value,change,unit,tolerance,beyond,core_seconds,core_s_per_s,work_units_per_s,failure.
std::string ablate_csv(const AblateReport& report);
std::string ablate_json(const AblateReport& report);

}  // namespace granvof::compare
