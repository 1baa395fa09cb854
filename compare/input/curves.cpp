#include "compare/input/curves.hpp"

#include <algorithm>

#include "compare/input/published.hpp"
#include "compare/metrics/base_pressure.hpp"
#include "compare/metrics/dam_break.hpp"
#include "compare/metrics/solid_level.hpp"
#include "solver/output/extract_bed.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

Curve run_out_by(const Run& run, const char* front) {
  if (!run.scene.bed) return {};
  return run_out(run.curve(front), column_of(run));
}

}  // namespace

ColumnSize column_of(const Run& run) {
  return {run.facts.number("released_height_m").value_or(run.scene.bed->nominal_height), run.scene.gravity};
}

Curve run_out_curve(const Run& run) {
  return run_out_by(run, "front_dilute");
}

Curve run_out_dense_curve(const Run& run) {
  return run_out_by(run, "front_dense");
}

Curve run_out_quantile_curve(const Run& run) {
  return run_out_by(run, "front_quantile");
}

Curve free_front(const Run& run) {
  return before_wall(run.curve("front_dense"), run.scene.tank[0], run.scene.grid.spacing[0]);
}

double base_pressure_at_rest(const Scene& scene) {
  double level = 0.0;
  for (const Box& box : scene.liquid_boxes) level = std::max(level, box.upper[1]);
  CellFields grid;
  grid.cells = scene.grid.cells;
  grid.spacing = scene.grid.spacing;
  const double lowest = 0.5 * grid.spacing[1];
  const double base = scene.obstacles.empty() ? lowest : scalar::base_height(grid, scene).value_or(lowest);
  const double depth = level - base;
  return normal_gravity(scene) * (scene.liquid.density * depth + scene.gas.density * (scene.tank[1] - level));
}

Curve excess_base_pressure(const Run& run) {
  return excess_pressure(run.curve("p_base"), base_pressure_at_rest(run.scene));
}

std::optional<DepositShape> deposit_at(const Run& run, double scaled_time) {
  if (!run.scene.bed) return std::nullopt;
  const auto fields = run.solid_fraction_at(scaled_time * collapse_time(column_of(run)));
  if (!fields) return std::nullopt;
  return deposit_shape(
      bed_profile(fields->f_s, fields->cells, fields->spacing, run.scene.contact.solid_fraction_min));
}

Curve scaled_liquid_front(const Run& run) {
  if (run.scene.liquid_boxes.empty()) return {};
  const Box& box = run.scene.liquid_boxes.front();
  return dam_break_front(run.curve("liquid_front"), box.upper[0] - box.lower[0], run.scene.gravity, 0.175);
}

Curve solid_level_curve(const Run& run, double level) {
  Curve curve;
  const std::size_t instants = run.field_times().size();
  for (std::size_t i = 0; i < instants; ++i) {
    const CellFields fields = read_solid_fraction(run.directory / "fields.h5", i);
    const auto height = solid_level(fields.f_s, fields.cells, fields.spacing[1], level);
    if (!height) continue;
    curve.time.push_back(fields.time);
    curve.value.push_back(*height);
  }
  return curve;
}

Curve published_curve(const Run& run, const std::string& file, const std::string& column) {
  return read_published(run.scene.file.parent_path() / "published" / file, column);
}

}  // namespace granvof::compare
