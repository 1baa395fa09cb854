#include "compare/checks/of_a_curve.hpp"

#include "compare/input/curves.hpp"
#include "compare/metrics/base_pressure.hpp"
#include "compare/metrics/run_out.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof::compare {

Measured dam_break_distance(const Run& run, const Parameters& p, const FindRun&) {
  return measured(
      rms_distance(scaled_liquid_front(run), published_curve(run, *p.published, *p.column), *p.window),
      "the two curves do not cover the window");
}

Measured grain_front_distance(const Run& run, const Parameters& p, const FindRun&) {
  return measured(
      rms_distance(run.curve("front_dilute"), published_curve(run, *p.published, *p.column), *p.window),
      "the two curves do not cover the window");
}

Measured base_pressure_distance(const Run& run, const Parameters& p, const FindRun&) {
  return measured(
      rms_distance(excess_base_pressure(run), published_curve(run, *p.published, *p.column), *p.window),
      "the two curves do not cover the window");
}

Measured solid_level_distance(const Run& run, const Parameters& p, const FindRun&) {
  return measured(rms_distance(solid_level_curve(run, *p.level),
                               published_curve(run, *p.published, *p.column), *p.window),
                  "the two curves do not cover the window");
}

Curve grain_front_curve(const Run& run) {
  return run.curve("front_dilute");
}

Measured grain_front_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(grain_front_curve(run), *p.at), "no grain front at that time");
}

Measured solid_height_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(run.curve("y_solid_mean"), *p.at), "no solids at that time");
}

Measured liquid_height_at(const Run& run, const Parameters& p, const FindRun&) {
  const auto energy = value_at(run.curve("potential_energy_liquid"), *p.at),
             volume = value_at(run.curve("liquid_volume"), *p.at);
  const double weight = run.scene.liquid.density * normal_gravity(run.scene);
  if (!energy || !volume || *volume <= 0.0 || weight <= 0.0) return {std::nullopt, "no liquid at that time"};
  return {*energy / (weight * *volume), ""};
}

Measured solid_volume_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(run.curve("solid_volume"), *p.at), "no solids at that time");
}

Measured granular_temperature_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(run.curve("theta_max"), *p.at), "no grains at that time");
}

Measured kinetic_energy_of_grains(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(run.curve("kinetic_energy_solid"), *p.at), "no grains at that time");
}

Measured interface_height_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(run.curve("interface_height"), *p.at), "no interface at that time");
}

Measured liquid_front_at(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(scaled_liquid_front(run), *p.at), "no liquid front at that tau");
}

}  // namespace granvof::compare
