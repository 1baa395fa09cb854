#include "compare/checks/registry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "compare/checks/last_instant.hpp"
#include "compare/checks/of_a_curve.hpp"
#include "compare/checks/start_state.hpp"
#include "compare/checks/whole_run.hpp"
#include "compare/input/curves.hpp"
#include "compare/input/shared_ledger.hpp"
#include "compare/metrics/base_pressure.hpp"
#include "compare/metrics/bed_slope.hpp"
#include "compare/metrics/decay_rate.hpp"
#include "compare/metrics/deposit_shape.hpp"
#include "compare/metrics/immersion.hpp"
#include "compare/metrics/period.hpp"
#include "compare/metrics/power_law.hpp"
#include "compare/metrics/run_out.hpp"
#include "compare/metrics/series_difference.hpp"
#include "compare/metrics/toe_drift.hpp"

namespace granvof::compare {

Measured measured(std::optional<double> value, std::string_view why_undefined) {
  if (value) return {value, ""};
  return {std::nullopt, fmt::format("undefined: {}", why_undefined)};
}

namespace {

// --- collapse ------------------------------------------------------------------------------------------

template <Curve (*curve)(const Run&)>
Measured value_of(const Run& run, const Parameters& p, const FindRun&) {
  return measured(value_at(curve(run), *p.at), "no value at that time");
}

Measured not_alone(const Run&, const Parameters&, const FindRun&) {
  return {std::nullopt, "undefined: a whole curve is judged by a record only"};
}

Measured run_out_apart(const Run& run, const Parameters& p, const FindRun& find) {
  const Run* other = find(*p.against);
  if (!other) return {std::nullopt, fmt::format("the run '{}' cannot be compared", *p.against)};
  return measured(rms_distance(run_out_curve(run), run_out_curve(*other), *p.window),
                  "the two curves do not cover the window");
}

Measured run_out_exponent(const Run& run, const Parameters& p, const FindRun&) {
  const auto fit = power_law(free_front(run), *p.window);
  return measured(fit ? std::optional(fit->exponent) : std::nullopt,
                  "fewer than two samples of the front before it meets the far wall");
}

Measured deposit_height(const Run& run, const Parameters& p, const FindRun&) {
  const auto shape = deposit_at(run, *p.at);
  if (!shape) return {std::nullopt, "undefined: no fields with a bed at that T"};
  return {shape->peak / column_of(run).height, ""};
}

Measured flat_top(const Run& run, const Parameters& p, const FindRun&) {
  const auto shape = deposit_at(run, *p.at);
  return measured(shape ? std::optional(shape->flat_top) : std::nullopt, "no fields with a bed at that T");
}

Measured slope_drift(const Run& run, const Parameters& p, const FindRun&) {
  return measured(slope_change(run.curve("slope"), *p.window), "no slope at the ends of the window");
}

Measured toe_drift(const Run& run, const Parameters& p, const FindRun&) {
  const auto move = largest_move(run.curve("front_quantile"), *p.window);
  if (!move) return {std::nullopt, "undefined: no front at the ends of the window"};
  return {*move / column_of(run).height, ""};
}

Measured base_pressure_peak(const Run& run, const Parameters& p, const FindRun&) {
  return measured(peak_pressure(excess_base_pressure(run), *p.window), "no base pressure in the window");
}

Measured base_pressure_sign(const Run& run, const Parameters& p, const FindRun&) {
  return measured(onset_sign(excess_base_pressure(run), *p.window, *p.quiet),
                  "no base pressure in the window");
}

// --- floating bed --------------------------------------------------------------------------------------

Measured immersed_share_of(const Run& run, const Parameters& p, const char* centre, const char* height) {
  const auto found =
      immersion(run.curve(centre), run.curve(height), run.curve("interface_height"), *p.window);
  return measured(found ? std::optional(found->share()) : std::nullopt,
                  "the bed has not compacted in the window");
}

// The paper's own: y_c and H of the cells with f_s > 0.95 f_s,min. Both jump by half a cell when a row of
// cells passes the threshold.
Measured immersed_share_cells(const Run& run, const Parameters& p, const FindRun&) {
  return immersed_share_of(run, p, "y_c", "bed_height");
}

// As the paper's, with the free surface beside the bed.
Measured immersed_share_free(const Run& run, const Parameters& p, const FindRun&) {
  const auto found =
      immersion(run.curve("y_c"), run.curve("bed_height"), run.curve("interface_height_outside"), *p.window);
  return measured(found ? std::optional(found->share()) : std::nullopt,
                  "the bed has not compacted in the window");
}

// From all solids and their height at the packing of the dense rows: the same for a bed that holds together,
// and free of the threshold.
Measured immersed_share(const Run& run, const Parameters& p, const FindRun&) {
  return immersed_share_of(run, p, "y_solid_mean", "bed_height_equivalent");
}

Measured period(const Run& run, const Parameters& p, const FindRun&) {
  const auto found = oscillation(run.curve("y_solid_mean"), *p.window);
  return measured(found ? std::optional(found->period) : std::nullopt, "fewer than two cycles in the window");
}

Measured level_period(const Run& run, const Parameters& p, const FindRun&) {
  return measured(fitted_period(run.curve("liquid_height_left"), *p.window),
                  "fewer than two cycles in the window");
}

// The place of rest is the mean over the last tenth of the run. `least` is the smallest deviation that is
// used [m].
Measured decay_rate_of(const Run& run, Window window, double least) {
  Curve height = run.curve("y_solid_mean");
  if (height.empty()) return {std::nullopt, "undefined: no solids"};
  const auto rest = time_mean(clip(height, {0.9 * height.time.back(), height.time.back()}));
  if (!rest) return {std::nullopt, "undefined: the run is too short"};
  return measured(approach_rate(resolved_part(clip(height, window), *rest, least), window, *rest),
                  "the curve does not decay in the window");
}

// Only while the bed is at least half a cell off: nearer to rest its edge and the interface move inside one
// cell, and what is measured is how that cell fills.
Measured decay_rate(const Run& run, const Parameters& p, const FindRun&) {
  return decay_rate_of(run, *p.window, 0.5 * run.scene.grid.spacing[1]);
}

Measured decay_rate_late(const Run& run, const Parameters& p, const FindRun&) {
  return decay_rate_of(run, *p.window, 0.0);
}

// --- shares of a window ----------------------------------------------------------------------------------

Measured energy_share(const Run& run, const Parameters& p, const FindRun&) {
  if (!run.scene.bed) return {std::nullopt, "undefined: no column"};
  const double unit = collapse_time(column_of(run));
  return measured(share_of_released(run, *p.term, {unit * p.window->begin, unit * p.window->end}),
                  "no energy budget in the series, or nothing released in the window");
}

Measured power(const Run& run, const Parameters& p, const FindRun&) {
  return measured(power_of(run, *p.term, *p.window), "no energy budget in the series, or not all the window");
}

// --- the same run otherwise stated ------------------------------------------------------------------------

Measured difference_of_series(const Run& run, const Parameters& p, const FindRun& find) {
  const Run* other = find(*p.against);
  if (!other) return {std::nullopt, fmt::format("the run '{}' cannot be compared", *p.against)};
  const auto found = series_difference(run.series, run.scene, other->series, other->scene);
  if (!found) return {std::nullopt, "undefined: the two have not the same columns and times"};
  const std::string where =
      found->column.empty() ? "" : fmt::format("in {} at T = {:.4g}", found->column, found->time);
  return {found->largest, where};
}

Measured start(const Run& run, const Parameters&, const FindRun&) {
  const auto found = start_distance(run);
  if (!found) return {std::nullopt, "undefined: not a box of grains and a level of liquid on faces of cells"};
  return {found->largest, found->column.empty() ? "" : "in " + found->column};
}

constexpr Needs none{};
constexpr Needs window_only{.window = true};
constexpr Needs at_only{.at = true};

constexpr std::array table{
    MetricEntry{"run_out", "-", "(l - l0) / h0 at T = at, l by f_s >= 0.30", at_only,
                value_of<run_out_curve>},
    MetricEntry{"run_out_dense", "-", "the same by the paper's own front, f_s >= 0.95 f_s,min", at_only,
                value_of<run_out_dense_curve>},
    MetricEntry{"run_out_quantile", "-", "the same of the place that 99.5 % of the grains have not passed",
                at_only, value_of<run_out_quantile_curve>},
    MetricEntry{"run_out_curve", "-", "rms over T of run_out's distance from the record's", window_only,
                not_alone, run_out_curve},
    MetricEntry{"run_out_dense_curve", "-", "the same of run_out_dense", window_only, not_alone,
                run_out_dense_curve},
    MetricEntry{"run_out_quantile_curve", "-", "the same of run_out_quantile", window_only, not_alone,
                run_out_quantile_curve},
    MetricEntry{"run_out_distance", "-", "rms over T of the difference of the run-out curves of two runs",
                Needs{.window = true, .against = true}, run_out_apart},
    MetricEntry{"run_out_exponent", "-",
                "b of l = a t^b, eq (26), l by the dense front until it meets the far wall", window_only,
                run_out_exponent},
    MetricEntry{"flat_top", "-", "share of the deposit's length within 5 % of its greatest height, at T = at",
                at_only, flat_top},
    MetricEntry{"deposit_height", "-", "greatest height of the deposit over h0, at T = at", at_only,
                deposit_height},
    MetricEntry{"slope_drift", "deg", "slope at the end of the window less that at its begin", window_only,
                slope_drift},
    MetricEntry{"toe_drift", "-",
                "largest move over h0, in the window, of the place that 99.5 % of the grains have not passed",
                window_only, toe_drift},
    MetricEntry{"base_pressure", "Pa", "excess pore pressure at the base at t = at", at_only,
                value_of<excess_base_pressure>},
    MetricEntry{"base_pressure_curve", "Pa", "rms over t of base_pressure's distance from the record's",
                window_only, not_alone, excess_base_pressure},
    MetricEntry{"base_pressure_peak", "Pa",
                "excess pore pressure at the base, the value of largest magnitude", window_only,
                base_pressure_peak},
    MetricEntry{"base_pressure_sign", "-",
                "sign of the time integral of the excess pore pressure at the base",
                Needs{.window = true, .quiet = true}, base_pressure_sign},
    MetricEntry{"immersed_share", "-", "h/H of all solids, H at the packing of the dense rows, time means",
                window_only, immersed_share},
    MetricEntry{"immersed_share_cells", "-", "h/H of the cells with f_s > 0.95 f_s,min, eq (27), time means",
                window_only, immersed_share_cells},
    MetricEntry{"immersed_share_free", "-",
                "h/H of the cells with f_s > 0.95 f_s,min against the surface beside the bed", window_only,
                immersed_share_free},
    MetricEntry{"period", "s", "period of the height of all solids, from crossings of its mean", window_only,
                period},
    MetricEntry{"level_period", "s", "period of the strongest mode of the liquid's level at x = 0",
                window_only, level_period},
    MetricEntry{"decay_rate", "1/s",
                "k of y = rest + A exp(-k t), y the height of all solids, rest its late mean, to half a cell "
                "off rest",
                window_only, decay_rate},
    MetricEntry{"decay_rate_late", "1/s", "the same over the whole window, motion inside a cell included",
                window_only, decay_rate_late},
    MetricEntry{"dam_break_distance", "-", "rms over tau of the water front x/a against a published one",
                Needs{.window = true, .published = true}, dam_break_distance},
    MetricEntry{"grain_front_distance", "m",
                "rms over t of the grain front (f_s >= 0.30) against a published one",
                Needs{.window = true, .published = true}, grain_front_distance},
    MetricEntry{"base_pressure_distance", "Pa",
                "rms over t of the excess pore pressure at the base against a published one",
                Needs{.window = true, .published = true}, base_pressure_distance},
    MetricEntry{"solid_level_distance", "m",
                "rms over t of the height of a level of f_s against a published one",
                Needs{.window = true, .level = true, .published = true}, solid_level_distance},
    MetricEntry{"grain_front", "m", "grain front (f_s >= 0.30) at t = at", at_only, grain_front_at},
    MetricEntry{"solid_height", "m", "height of the centre of mass of all solids at t = at", at_only,
                solid_height_at},
    MetricEntry{"liquid_height", "m", "height of the centre of mass of all liquid at t = at", at_only,
                liquid_height_at},
    MetricEntry{"solid_volume", "m3", "volume of all solids at t = at", at_only, solid_volume_at},
    MetricEntry{"energy_share", "-",
                "what a term of the energy takes of the potential energy released in a window of T, in terms "
                "that DEM-VOF counts alike",
                Needs{.window = true, .term = true}, energy_share},
    MetricEntry{"power", "W/m3",
                "what a term of the energy takes in a window, a second and volume of the tank",
                Needs{.window = true, .term = true}, power},
    MetricEntry{"granular_temperature", "m2/s2", "largest Theta where f_s >= 0.1 f_s,min at t = at", at_only,
                granular_temperature_at},
    MetricEntry{"interface_height", "m", "height of alpha = 0.5 in the profile over the tank at t = at",
                at_only, interface_height_at},
    MetricEntry{"liquid_front", "-", "x / a of the water front at tau = at", at_only, liquid_front_at},
    MetricEntry{"grain_front_curve", "m", "rms over t of grain_front's distance from the record's",
                window_only, not_alone, grain_front_curve},
    MetricEntry{"liquid_front_curve", "-", "rms over tau of liquid_front's distance from the record's",
                window_only, not_alone, scaled_liquid_front},
    MetricEntry{
        "hydrostatic_distance", "-",
        "largest distance of P_c from that of a tank full of liquid at rest, over its largest, at the end",
        none, hydrostatic},
    MetricEntry{"ergun_ratio", "-",
                "pressure that a bed takes from the flow through it, over Ergun's, at the end", none, ergun},
    MetricEntry{"bed_weight_distance", "-",
                "largest distance of P_s from the weight of the grains above, over its largest, at the end",
                none, bed_weight},
    MetricEntry{"start_distance", "-",
                "largest distance of a column at the start from what the scene says it is, over the latter",
                none, start},
    MetricEntry{"kinetic_energy", "J", "of the mean motion of the grains at t = at", at_only,
                kinetic_energy_of_grains},
    MetricEntry{"solid_pressure", "Pa", "mean P_s of the cells with grains at the end", none, solid_pressure},
    MetricEntry{"asymmetry", "-",
                "largest difference of f_s or alpha between a cell and its mirror image in x, at the end",
                none, asymmetry},
    MetricEntry{"liquid_depth", "m", "of the liquid in the middle of the tank, at the end", none,
                middle_depth},
    MetricEntry{
        "film_distance", "-",
        "largest distance of the flow in the middle of the tank from Nusselt's film, over its largest, "
        "at the end",
        none, film},
    MetricEntry{
        "reattachment_length", "-",
        "over which the flow behind an obstacle goes back along the floor, over its height, at the end", none,
        reattachment},
    MetricEntry{"settling_slip", "m/s", "u_c - u_s along y at mid-height at the end", none, settling_slip},
    MetricEntry{"solid_volume_error", "-", "largest relative change of the solid volume", none,
                solid_volume_error},
    MetricEntry{"liquid_volume_error", "-", "largest relative change of the liquid volume", none,
                liquid_volume_error},
    MetricEntry{"solid_fraction_max", "-", "largest f_s of any cell at any time", none, solid_fraction_max},
    MetricEntry{"solid_fraction_min", "-", "smallest f_s of any cell", none, solid_fraction_min},
    MetricEntry{"liquid_speed_max", "m/s", "largest speed where most of a cell is liquid", window_only,
                liquid_speed_max},
    MetricEntry{"fluid_speed_max", "m/s", "largest speed of the fluid, gas included", window_only,
                fluid_speed_max},
    MetricEntry{"solid_speed_max", "m/s", "largest solid speed where f_s >= 0.95 f_s,min", window_only,
                solid_speed_max},
    MetricEntry{"series_difference", "-",
                "largest difference of any column of series.csv from that of another run, at the rows both "
                "have, each in its own scene's scales",
                Needs{.against = true}, difference_of_series},
    MetricEntry{
        "energy_closure", "-",
        "largest difference between the change of all energy and the sum of its parts, over the energy "
        "turned over",
        none, energy_closure},
    MetricEntry{"ledger_share", "-",
                "what a scheme (a term of the ledger, or numerical: all of them) took by the end of the "
                "energy turned over; negative: gave",
                Needs{.scheme = true}, ledger_share},
    MetricEntry{"ledger_order", "-",
                "power of the cell, or of the step where cells are the same, with which what a scheme took "
                "vanishes, from a coarser run to this one",
                Needs{.against = true, .scheme = true}, ledger_order},
    MetricEntry{"energy_created", "-",
                "energy that schemes, and solid pressure that nothing pays for, gave by the end, over what "
                "the flow was given otherwise",
                none, energy_created},
    MetricEntry{"warnings", "-", "monitors of the run that passed their limits", none, warnings},
    MetricEntry{"core_seconds", "core-s", "CPU time of the time loop", none, core_seconds, nullptr, true},
};

}  // namespace

std::span<const MetricEntry> metrics() {
  return table;
}

const MetricEntry* find_metric(std::string_view name) {
  const auto* found =
      std::find_if(table.begin(), table.end(), [&](const MetricEntry& e) { return e.name == name; });
  return found == table.end() ? nullptr : found;
}

}  // namespace granvof::compare
