#include "compare/study/budget.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
double Plan::core_seconds() const {
  double sum = 0.0;
  for (const PlannedGrid& grid : grids) sum += grid.core_seconds;
  return sum;
}

double estimated_seconds(const Job& job, Runner& runner) {
  if (runner.has(job)) return 0.0;
  const double once = estimate_cost(load_scene(job.case_file, job.set)).core_seconds;
  return once < cheap_run ? timings_of_a_cheap_run * once : once;
}

Plan plan_of(const std::vector<double>& cells, const std::vector<std::vector<Job>>& jobs, Runner& runner) {
  Plan plan;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    PlannedGrid grid{cells[i], 0, 0, 0.0};
    for (const Job& job : jobs[i]) {
      const double seconds = estimated_seconds(job, runner);
      ++(seconds > 0.0 ? grid.runs : grid.kept);
      grid.core_seconds += seconds;
    }
    plan.grids.push_back(grid);
  }
  return plan;
}

Outcome BudgetedRunner::run(const Job& job) {
  const double estimate = estimated_seconds(job, inner_);
  if (estimate == 0.0) return inner_.run(job);
  const double correction = expected_ > 0.0 ? spent_ / expected_ : 1.0;
  if (spent_ + correction * estimate > budget_) {
    ++left_out_;
    Outcome outcome;
    outcome.failure =
        fmt::format("left out: about {} more, and {} of the budget of {} are spent",
                    duration_text(correction * estimate), duration_text(spent_), duration_text(budget_));
    return outcome;
  }
  Outcome made = inner_.run(job);
  spent_ += made.core_seconds * std::max(made.repeats, 1);
  expected_ += estimate;
  return made;
}

}  // namespace granvof::compare
