#include "solver/scene/restate.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "solver/scene/case_text.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"

namespace granvof {
namespace {

using case_file::TimeUnit;
using case_file::Value;

Dimension dimension_of_key(const case_file::Key& key, TimeUnit unit_of_times) {
  const bool of_times = key.unit == case_file::unit_of_times;
  const auto dimension = dimension_of(of_times ? (unit_of_times == TimeUnit::second ? "s" : "") : key.unit);
  if (!dimension) throw std::logic_error(fmt::format("{}: unknown unit {}", key.name, key.unit));
  return *dimension;
}

Value times(double factor, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return factor * *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return factor * static_cast<double>(*whole);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    std::vector<double> scaled = *list;
    for (double& number : scaled) number *= factor;
    return scaled;
  }
  return value;
}

}  // namespace

std::string restated_case(const Scene& scene, const UnitFactors& factors) {
  case_file::CaseText text = case_file::read_case_text(scene.resolved, scene.file.string(), {});
  const TimeUnit unit_of_times = case_file::read_draft(text).times.unit;
  for (auto& [name, entry] : text.entries) {
    const Dimension dimension = dimension_of_key(*case_file::find_key(name), unit_of_times);
    if (!dimension.none()) entry.value = times(factors.of(dimension), entry.value);
  }
  return case_file::resolved_text(case_file::read_draft(text));
}

}  // namespace granvof
