#include "compare/study/answer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace granvof::compare {
namespace {

// What errors of the model are relative to, as like_scene.hpp has them.
double scale_of_model(const Observed& observed) {
  double largest = std::abs(observed.value.value_or(0.0));
  for (const double value : observed.curve.value) largest = std::max(largest, std::abs(value));
  return largest;
}

// What the preset was off by in the nearest recorded scene, relative.
std::optional<double> error_of_model(const AdviseReport& report) {
  std::optional<double> error;
  if (report.input.like.empty()) return error;
  for (const ModelError& known : report.input.like.front().errors)
    if (known.preset == report.preset) error = std::max(error.value_or(0.0), known.highest);
  return error;
}

}  // namespace

std::optional<Answer> answer_of(const AdviseReport& report) {
  Answer answer;
  answer.confirmed = report.advice.chosen.has_value();
  const Observed& observed = answer.confirmed ? report.observed : report.target.observed;
  if (!observed.defined()) return std::nullopt;
  if (observed.value) {
    answer.value = *observed.value;
  } else {
    const auto& window = report.input.quantity.parameters.window;
    const Curve seen = window ? clip(observed.curve, *window) : observed.curve;
    if (seen.empty()) return std::nullopt;
    answer.value = seen.value.back();
    answer.end = seen.time.back();
  }
  const double scale = scale_of(report.input.quantity, report.target.observed).value_or(0.0);
  const double error = answer.confirmed ? report.advice.chosen->trial.error.value_or(0.0) : 0.0;
  const double floor = report.target.floor;
  if (report.target.kind != kind_of_own) {
    answer.by_both = scale * (answer.confirmed ? error : floor);
    return answer;
  }
  answer.by_grid = scale * std::max({error, floor, report.advice.moved.value_or(0.0)});
  if (const auto model = error_of_model(report)) answer.by_model = *model * scale_of_model(observed);
  return answer;
}

std::string answer_text(const AdviseReport& report, const Answer& answer) {
  const Quantity& quantity = report.input.quantity;
  std::string text = "answer: ";
  if (!answer.confirmed)
    text += fmt::format("none to {:g} %; {} gives ", 100.0 * report.input.tolerance, report.target.source);
  text += quantity.label();
  if (answer.end)
    text += fmt::format(" at the end of the curve, {} = {:.3g},", quantity.abscissa(), *answer.end);
  text += fmt::format(" {:.3g} [{}]", answer.value, quantity.unit());
  if (answer.by_both)
    return text + fmt::format(", +- {:.2g} by {}", *answer.by_both,
                              answer.confirmed ? "model and grid together, as against " + report.target.kind
                                               : "its own uncertainty");
  text += fmt::format(", +- {:.2g} by the grid", answer.by_grid.value_or(0.0));
  if (!answer.by_model) return text + "; by the model: not known";
  const LikeScene& like = report.input.like.front();
  return text + fmt::format(", +- {:.2g} by the model as preset {} in {}{}", *answer.by_model, report.preset,
                            like.case_name, like.farthest <= near_factor ? "" : ", which is not near");
}

}  // namespace granvof::compare
