#include "compare/checks/last_instant.hpp"

#include "compare/metrics/flow_section.hpp"
#include "compare/metrics/fluid_pressure.hpp"
#include "compare/metrics/known_state.hpp"
#include "solver/output/fields_file.hpp"

namespace granvof::compare {
namespace {

template <typename Measure>
Measured of_last_fields(const Run& run, Measure measure, std::string_view why_undefined) {
  const std::size_t instants = run.field_times().size();
  if (instants == 0) return {std::nullopt, "undefined: no fields"};
  return measured(measure(read_fields(run.directory / "fields.h5", instants - 1)), why_undefined);
}

}  // namespace

Measured hydrostatic(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [&](const CellFields& f) { return std::optional(hydrostatic_distance(f, run.scene)); }, "");
}

Measured ergun(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [&](const CellFields& f) { return std::optional(ergun_ratio(f, run.scene)); }, "");
}

Measured bed_weight(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [&](const CellFields& f) { return weight_distance(f, run.scene); }, "no bed, or no P_s");
}

Measured solid_pressure(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(run, mean_solid_pressure, "no grains, or no P_s");
}

Measured settling_slip(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(run, slip_in_the_middle, "no grains at mid-height");
}

Measured asymmetry(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [](const CellFields& f) { return std::optional(mirror_distance(f)); }, "");
}

Measured middle_depth(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [](const CellFields& f) { return std::optional(liquid_depth_in_the_middle(f)); }, "");
}

Measured film(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [&](const CellFields& f) { return film_distance(f, run.scene); }, "no liquid in the middle");
}

Measured reattachment(const Run& run, const Parameters&, const FindRun&) {
  return of_last_fields(
      run, [&](const CellFields& f) { return reattachment_length(f, run.scene); },
      "no flow back along the floor behind an obstacle");
}

}  // namespace granvof::compare
