#include "compare/input/shared_ledger.hpp"

#include <algorithm>
#include <array>

namespace granvof::compare {
namespace {

// Columns that add to a term, and those that are taken from it; one that ends in * stands for all that begin
// so.
struct SharedTerm {
  std::string_view name;
  std::vector<std::string_view> plus, minus;
};

constexpr std::string_view of_every_ledger = "lost_drag";  // a series without it has none

const std::vector<SharedTerm>& terms_counted_alike() {
  static const std::vector<SharedTerm> terms{
      {"released", {}, {"energy_potential"}},
      {"motion", {"energy_kinetic"}, {}},
      {"agitation", {"energy_granular", "energy_spin"}, {}},
      {"elastic", {"energy_elastic"}, {}},
      {"contacts",
       {"lost_friction", "lost_collisions", "lost_contacts"},
       {"gained_dilatancy", "gained_shear_dilatancy"}},
      {"walls", {"lost_walls"}, {"gained_walls", "gained_gate"}},
      {"drag", {"lost_drag"}, {}},
      {"viscosity", {"lost_viscosity"}, {}},
      {"numerics", {"lost_numerical_*"}, {}},
  };
  return terms;
}

bool is_meant(std::string_view pattern, std::string_view column) {
  return pattern.ends_with('*') ? column.starts_with(pattern.substr(0, pattern.size() - 1))
                                : column == pattern;
}

void add(Curve& sum, const Run& run, const std::vector<std::string_view>& patterns, double sign) {
  for (const auto& column : run.series.columns) {
    if (std::ranges::none_of(patterns, [&](std::string_view p) { return is_meant(p, column.name); }))
      continue;
    const Curve curve = run.curve(column.name);
    if (curve.empty()) continue;
    if (sum.empty()) sum = {curve.time, std::vector<double>(curve.time.size(), 0.0)};
    if (curve.time.size() != sum.time.size()) continue;
    for (std::size_t i = 0; i < curve.value.size(); ++i)
      sum.value[i] += sign * (curve.value[i] - curve.value.front());
  }
}

}  // namespace

std::vector<std::string_view> shared_terms() {
  std::vector<std::string_view> names;
  for (const SharedTerm& term : terms_counted_alike()) names.push_back(term.name);
  return names;
}

Curve shared_term(const Run& run, std::string_view term) {
  const auto found = std::ranges::find(terms_counted_alike(), term, &SharedTerm::name);
  Curve sum;
  if (found == terms_counted_alike().end() || run.curve(of_every_ledger).empty()) return sum;
  add(sum, run, found->plus, 1.0);
  add(sum, run, found->minus, -1.0);
  return sum;
}

namespace {

// How much a term grows between two times [J].
std::optional<double> gained(const Run& run, std::string_view term, Window times) {
  const Curve curve = shared_term(run, term);
  const auto begin = value_at(curve, times.begin), end = value_at(curve, times.end);
  if (!begin || !end) return std::nullopt;
  return *end - *begin;
}

}  // namespace

std::optional<double> share_of_released(const Run& run, std::string_view term, Window times) {
  const auto released = gained(run, "released", times), taken = gained(run, term, times);
  if (!released || !taken || !(*released > 0.0)) return std::nullopt;
  return *taken / *released;
}

std::optional<double> power_of(const Run& run, std::string_view term, Window times) {
  const auto taken = gained(run, term, times);
  const double seconds = times.end - times.begin;
  if (!taken || !(seconds > 0.0)) return std::nullopt;
  return *taken / (seconds * run.scene.tank[0] * run.scene.tank[1] * run.scene.tank[2]);
}

}  // namespace granvof::compare
