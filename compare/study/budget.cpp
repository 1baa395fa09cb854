#include "compare/study/budget.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

struct Unit {
  std::string_view name;
  double seconds;
};

constexpr std::array units{Unit{"min", 60.0}, Unit{"s", 1.0}, Unit{"h", 3600.0}};

}  // namespace

double Plan::core_seconds() const {
  double sum = 0.0;
  for (const PlannedGrid& grid : grids) sum += grid.core_seconds;
  return sum;
}

double estimated_seconds(const Job& job, Runner& runner) {
  if (runner.has(job)) return 0.0;
  const double once = estimate_cost(load_scene(job.case_file, job.set)).core_seconds;
  const RunnerOptions usual;
  return once < usual.repeat_below ? timings_of_a_cheap_run * once : once;
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

double read_duration(std::string_view text) {
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view rest(parsed.ptr, static_cast<std::size_t>(text.data() + text.size() - parsed.ptr));
  if (parsed.ec == std::errc() && std::isfinite(value) && value > 0.0)
    for (const Unit& unit : units)
      if (rest == unit.name) return value * unit.seconds;
  throw std::invalid_argument(
      fmt::format("'{}' given; allowed: a time with its unit, as 90s, 10min or 2h", text));
}

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 6000.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.2g} h", seconds / 3600.0);
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
