// What a walk of `advise` may cost, before it starts, and a runner that keeps to it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/study/runner.hpp"
#include "solver/scene/duration.hpp"

namespace granvof::compare {

// What the runs on one grid cost together; those that are kept cost nothing.
struct PlannedGrid {
  double cell;  // [m]
  int runs;     // that are not kept
  int kept;
  double core_seconds;  // estimated
};

struct Plan {
  std::vector<PlannedGrid> grids;  // large to small
  double core_seconds() const;
};

// CPU time that the runner needs for a job [s]: solver/scene/cost_estimate.hpp, three times where it times a
// cheap run three times; 0 for a job that is kept or refused.
double estimated_seconds(const Job& job, Runner& runner);

// The jobs grid by grid, `jobs[i]` on `cells[i]`.
Plan plan_of(const std::vector<double>& cells, const std::vector<std::vector<Job>>& jobs, Runner& runner);

// Passes jobs on until what they took is the budget: a job that would go beyond it (by the estimate,
// corrected by what those before it took) is not started, and its outcome says so.
class BudgetedRunner : public Runner {
 public:
  // `core_seconds` > 0. `inner` must outlive this.
  BudgetedRunner(Runner& inner, double core_seconds) : inner_(inner), budget_(core_seconds) {}
  Outcome run(const Job& job) override;
  bool has(const Job& job) override { return inner_.has(job); }
  double spent() const { return spent_; }
  int left_out() const { return left_out_; }

 private:
  Runner& inner_;
  double budget_;
  double spent_ = 0.0, expected_ = 0.0;  // core-s; of those made, what was estimated
  int left_out_ = 0;
};

}  // namespace granvof::compare
