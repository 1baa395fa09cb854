#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "compare/output/write.hpp"

namespace granvof::compare {
namespace {

std::string csv_field(std::string text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

std::string short_number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

}  // namespace

std::string metric_label(const Check& check) {
  std::string label = labelled(check.metric, check.parameters);
  if (!check.label.empty()) label += fmt::format(" ({})", check.label);
  return label;
}

std::string tolerance_text(const Check& check) {
  std::string text = check.tolerance.relative
                         ? fmt::format("{:g} %", 100.0 * check.tolerance.value)
                         : fmt::format("{:g} [{}]", check.tolerance.value, check.tolerance.unit);
  if (check.relation != Relation::equal) text = fmt::format("{}, within {}", name_of(check.relation), text);
  return check.asserted ? text : text + ", reported only";
}

std::string results_csv(const Evaluation& evaluation) {
  std::string text = "scene,metric,value,unit,reference,reference_kind,reference_source,tolerance,verdict\n";
  for (const Result& result : evaluation.results) {
    const Check& check = result.check;
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(check.run), csv_field(metric_label(check)),
                        csv_number(result.value), csv_field(result.unit), csv_number(result.reference),
                        name_of(check.reference.kind), csv_field(check.reference.source),
                        csv_field(tolerance_text(check)), name_of(result.judgement.verdict));
  }
  return text;
}

std::string terminal_table(const Evaluation& evaluation) {
  std::string text = fmt::format("  {:<26} {:<26} {:>11} {:>11} {:<7} {:<24} {}\n", "scene", "metric",
                                 "value", "reference", "unit", "tolerance", "verdict");
  std::map<std::string_view, int> counts;
  for (const Result& result : evaluation.results) {
    const Check& check = result.check;
    const Judgement& judgement = result.judgement;
    ++counts[name_of(judgement.verdict)];
    std::string verdict{name_of(judgement.verdict)};
    const bool off = judgement.verdict == Verdict::differs || judgement.verdict == Verdict::reported;
    if (off && result.value) verdict += fmt::format(" by {:.3g}", judgement.deviation);
    if (!result.note.empty()) verdict += fmt::format(" ({})", result.note);
    text += fmt::format("{} {:<26} {:<26} {:>11} {:>11} {:<7} {:<24} {}\n", judgement.unexpected ? "!" : " ",
                        check.run, metric_label(check), short_number(result.value),
                        short_number(result.reference), result.unit, tolerance_text(check), verdict);
  }
  std::string left_out;
  for (const Result& result : evaluation.results)
    if (result.judgement.verdict == Verdict::not_run && !result.judgement.unexpected && result.check.asserted)
      left_out += fmt::format("{}{}", left_out.empty() ? "left out by name: " : ", ", result.check.id);
  if (!left_out.empty()) text += left_out + "\n";
  for (const RunSummary& run : evaluation.runs)
    if (run.state != RunState::usable) text += fmt::format("{}: {}\n", run.plan.id, run.reason);
  text += fmt::format("{} checks:", evaluation.results.size());
  for (const auto& [name, count] : counts) text += fmt::format(" {} {},", count, name);
  const int unexpected = evaluation.unexpected();
  text += unexpected == 0 ? " nothing unexpected\n" : fmt::format(" {} UNEXPECTED (marked !)\n", unexpected);
  return text;
}

}  // namespace granvof::compare
