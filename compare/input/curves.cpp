#include "compare/input/curves.hpp"

#include <algorithm>

#include "compare/metrics/base_pressure.hpp"

namespace granvof::compare {
ColumnSize column_of(const Scene& scene) {
  return {scene.bed->box.upper[1] - scene.bed->box.lower[1], scene.gravity};
}

Curve run_out_curve(const Run& run) {
  if (!run.scene.bed) return {};
  // Others may give one front only; it then serves to the end.
  const bool both = run.series.has("front_dilute");
  return run_out(run.curve("front_dense"), run.curve(both ? "front_dilute" : "front_dense"),
                 column_of(run.scene));
}

double base_pressure_at_rest(const Scene& scene) {
  double level = 0.0;
  for (const Box& box : scene.liquid_boxes) level = std::max(level, box.upper[1]);
  const double depth = level - 0.5 * scene.grid.spacing[1];
  return scene.gravity * (scene.liquid.density * depth + scene.gas.density * (scene.tank[1] - level));
}

Curve excess_base_pressure(const Run& run) {
  return excess_pressure(run.curve("p_base"), base_pressure_at_rest(run.scene));
}

std::optional<DepositShape> deposit_at(const Run& run, double scaled_time) {
  if (!run.scene.bed) return std::nullopt;
  const auto fields = run.fields_at(scaled_time * collapse_time(column_of(run.scene)));
  if (!fields) return std::nullopt;
  return deposit_shape(
      bed_profile(fields->f_s, fields->cells, fields->spacing, run.scene.contact.solid_fraction_min));
}

}  // namespace granvof::compare
