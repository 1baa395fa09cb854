#include "compare/lay/lay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "compare/input/curves.hpp"
#include "compare/metrics/run_out.hpp"
#include "solver/output/extract.hpp"
#include "solver/output/fields_file.hpp"

namespace granvof::compare {
namespace {

// Quantities that are computed from columns, and that a series may also give directly.
struct Derived {
  std::string_view name;
  std::string_view unit;
  std::string_view source;  // the column it is computed from
  std::string_view abscissa;
  Curve (*function)(const Run&);
};

constexpr std::array derived{
    Derived{"run_out", "-", "front_dilute", "T [-]", run_out_curve},
    Derived{"run_out_dense", "-", "front_dense", "T [-]", run_out_dense_curve},
    Derived{"excess_base_pressure", "Pa", "p_base", "t [s]", excess_base_pressure},
};

const Derived* find_derived(std::string_view name) {
  const auto* found =
      std::find_if(derived.begin(), derived.end(), [&](const Derived& d) { return d.name == name; });
  return found == derived.end() ? nullptr : found;
}

std::string_view unit_of(std::string_view column) {
  if (const Derived* found = find_derived(column)) return found->unit;
  for (const ScalarEntry& entry : scalar_table())
    if (entry.name == column) return entry.unit;
  std::vector<std::string_view> known;
  known.reserve(derived.size() + scalar_table().size());
  for (const Derived& entry : derived) known.push_back(entry.name);
  for (const ScalarEntry& entry : scalar_table()) known.push_back(entry.name);
  throw std::invalid_argument(
      fmt::format("the column '{}' is not known; allowed: time, T, {}", column, fmt::join(known, ", ")));
}

// Given directly, or computed from its column; empty if the run holds neither.
Curve curve_of(const Run& run, const Derived& quantity) {
  if (!run.series.has(quantity.name))
    return run.series.has(quantity.source) ? quantity.function(run) : Curve{};
  Curve given = run.curve(quantity.name);
  if (quantity.abscissa != "T [-]") return given;
  const double tau = collapse_time(column_of(run));
  for (double& t : given.time) t /= tau;
  given.widest /= tau;
  return given;
}

// Finite numbers of a foreign file can be too large for their differences, squares or areas.
void require_finite(const LaidCurve& curve) {
  for (const auto& value : {curve.rms, curve.ours_at_end, curve.theirs_at_end, curve.ours_integral,
                            curve.theirs_integral, std::optional(curve.window.end - curve.window.begin)})
    if (value && !std::isfinite(*value))
      throw std::invalid_argument(
          fmt::format("the times or values of '{}' are too large to be compared", curve.name));
}

std::optional<LaidCurve> laid(std::string_view name, std::string_view unit, std::string_view abscissa,
                              Curve ours, Curve theirs) {
  if (ours.size() < 2 || theirs.size() < 2) return std::nullopt;
  // A quantity that neither has (no grains, no gas) says nothing.
  const auto zero = [](const Curve& curve) { return maximum(curve) == 0.0 && minimum(curve) == 0.0; };
  if (zero(ours) && zero(theirs)) return std::nullopt;
  const Window window{std::max(ours.time.front(), theirs.time.front()),
                      std::min(ours.time.back(), theirs.time.back())};
  if (!(window.begin < window.end)) return std::nullopt;
  LaidCurve result;
  result.name = name;
  result.unit = unit;
  result.abscissa = abscissa;
  result.ours = std::move(ours);
  result.theirs = std::move(theirs);
  result.window = window;
  result.rms = rms_distance(result.ours, result.theirs, window);
  result.ours_at_end = value_at(result.ours, window.end);
  result.theirs_at_end = value_at(result.theirs, window.end);
  result.ours_integral = integral(clip(result.ours, window));
  result.theirs_integral = integral(clip(result.theirs, window));
  require_finite(result);
  return result;
}

nlohmann::ordered_json number(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.5g}", *value) : "-";
}

}  // namespace

Run read_their_series(const std::filesystem::path& file, const Scene& scene) {
  Run run{file.stem().string(), file.parent_path(), scene, {}, read_series(file)};
  int times = 0;
  for (std::size_t c = 0; c < run.series.columns.size(); ++c) {
    Column& column = run.series.columns[c];
    const bool scaled = column.name == "T";
    const std::string_view unit =
        scaled ? "-" : (column.name == "time" ? std::string_view("s") : unit_of(column.name));
    if (column.unit != unit)
      throw std::invalid_argument(fmt::format("{}: the column '{}' is in '{}', expected '{}'", file.string(),
                                              column.name, column.unit, unit));
    for (std::size_t before = 0; before < c; ++before)
      if (run.series.columns[before].name == column.name)
        throw std::invalid_argument(
            fmt::format("{}: the column '{}' is given twice", file.string(), column.name));
    if (column.name != "time" && !scaled) continue;
    ++times;
    if (!scaled) continue;
    if (!scene.bed)
      throw std::invalid_argument(
          fmt::format("{}: T needs a scene with a bed, {} has none", file.string(), scene.name));
    for (auto& row : run.series.rows)
      if (row[c]) *row[c] *= collapse_time(column_of(run));
    column.name = "time";
  }
  const auto found = std::find_if(run.series.columns.begin(), run.series.columns.end(),
                                  [](const Column& column) { return column.name == "time"; });
  const auto at = static_cast<std::size_t>(found - run.series.columns.begin());
  for (std::size_t row = 1; found != run.series.columns.end() && row < run.series.rows.size(); ++row)
    if (!(run.series.rows[row][at] > run.series.rows[row - 1][at]))
      throw std::invalid_argument(
          fmt::format("{}: time does not ascend from row {} to row {}; compare/lay/lay sorts and converts",
                      file.string(), row, row + 1));
  if (times != 1)
    throw std::invalid_argument(
        fmt::format("{}: one column 'time [s]' or 'T [-]' is needed, there are {}", file.string(), times));
  return run;
}

namespace {

constexpr double overshoot = 0.05;  // of a share of volume beyond 0 and 1: what other codes' fluxes may leave

// Of values without a meaning every scalar would be a number all the same.
void require_shares(const std::vector<double>& values, const char* name, const std::string& where) {
  const auto bad = std::find_if(values.begin(), values.end(),
                                [](double v) { return v < -overshoot || v > 1.0 + overshoot; });
  if (bad != values.end())
    throw std::invalid_argument(
        fmt::format("{}: {} is {:.6g} in a cell, allowed: 0 to 1", where, name, *bad));
}

void require_times(const std::vector<double>& times, const std::filesystem::path& file) {
  if (times.empty()) throw std::invalid_argument(fmt::format("{}: it holds no instant", file.string()));
  for (std::size_t index = 0; index < times.size(); ++index)
    if (!(times[index] >= 0.0 && (index == 0 || times[index] > times[index - 1])))
      throw std::invalid_argument(
          fmt::format("{}: instant {} is of t = {} s, allowed: 0 or more, each later than the one before",
                      file.string(), index + 1, times[index]));
}

}  // namespace

Run read_their_fields(const std::filesystem::path& file, const Scene& scene) {
  Run run{file.stem().string(), file.parent_path(), scene, {}, {}};
  run.series.columns.push_back({"time", "s", ""});
  for (const ScalarEntry& entry : scalar_table())
    run.series.columns.push_back({std::string(entry.name), std::string(entry.unit), ""});
  const std::vector<double> times = read_field_times(file);
  require_times(times, file);
  for (std::size_t index = 0; index < times.size(); ++index) {
    CellFields fields = read_fields(file, index);
    const std::string where = fmt::format("{} at t = {} s", file.string(), fields.time);
    require_shares(fields.f_s, "f_s", where);
    require_shares(fields.alpha, "alpha", where);
    for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimensions); ++d) {
      const double length = fields.cells[d] * fields.spacing[d];
      if (std::abs(length - scene.tank[d]) > 1e-6 * scene.tank[d])
        throw std::invalid_argument(
            fmt::format("{}: the box is {:.6g} m in direction {}, the tank of {} {:.6g} m", file.string(),
                        length, d, scene.name, scene.tank[d]));
    }
    // In 2D a slice of any thickness stands for the depth the scene states.
    if (scene.dimensions == 2 && fields.cells[2] == 1) fields.spacing[2] = scene.tank[2];
    run.scene.grid.cells = fields.cells;
    run.scene.grid.spacing = fields.spacing;
    std::vector<Value> row{fields.time};
    for (const Value& value : extract_scalars(fields, run.scene)) row.push_back(value);
    run.series.rows.push_back(std::move(row));
  }
  return run;
}

std::vector<LaidCurve> lay(const Run& ours, const Run& theirs) {
  std::vector<LaidCurve> curves;
  const auto add = [&](std::optional<LaidCurve> curve) {
    if (curve) curves.push_back(std::move(*curve));
  };
  for (const Derived& quantity : derived)
    add(laid(quantity.name, quantity.unit, quantity.abscissa, curve_of(ours, quantity),
             curve_of(theirs, quantity)));
  for (const Column& column : theirs.series.columns) {
    if (column.name == "time" || find_derived(column.name)) continue;
    add(laid(column.name, column.unit, "t [s]", ours.curve(column.name), theirs.curve(column.name)));
  }
  if (curves.empty()) throw std::invalid_argument("the two series share no column over a common time");
  return curves;
}

std::string lay_table(const std::vector<LaidCurve>& curves, const std::string& their_name) {
  std::string text =
      fmt::format("{:<26} {:<6} {:>20} {:>12} {:>12} {:>12} {:>13} {:>13}\n", "quantity", "unit", "over",
                  "rms apart", "ours, end", "theirs, end", "our integral", "their integral");
  for (const LaidCurve& curve : curves)
    text += fmt::format("{:<26} {:<6} {:>20} {:>12} {:>12} {:>12} {:>13} {:>13}\n", curve.name, curve.unit,
                        fmt::format("{:.3g}-{:.3g} {}", curve.window.begin, curve.window.end, curve.abscissa),
                        shown(curve.rms), shown(curve.ours_at_end), shown(curve.theirs_at_end),
                        shown(curve.ours_integral), shown(curve.theirs_integral));
  return text + fmt::format("theirs: {}\n", their_name);
}

std::string lay_json(const std::vector<LaidCurve>& curves, const Run& ours, const std::string& their_name) {
  nlohmann::ordered_json json{{"scene", ours.scene.name},
                              {"theirs", their_name},
                              {"run",
                               {{"id", ours.id},
                                {"version", ours.facts.version},
                                {"commit", ours.facts.commit},
                                {"case_hash", ours.facts.case_hash},
                                {"host", ours.facts.host}}}};
  json["curves"] = nlohmann::ordered_json::array();
  for (const LaidCurve& curve : curves)
    json["curves"].push_back({{"name", curve.name},
                              {"unit", curve.unit},
                              {"abscissa", curve.abscissa},
                              {"window", {curve.window.begin, curve.window.end}},
                              {"rms", number(curve.rms)},
                              {"ours_at_end", number(curve.ours_at_end)},
                              {"theirs_at_end", number(curve.theirs_at_end)},
                              {"ours_integral", number(curve.ours_integral)},
                              {"theirs_integral", number(curve.theirs_integral)},
                              {"ours", {{"x", curve.ours.time}, {"y", curve.ours.value}}},
                              {"theirs", {{"x", curve.theirs.time}, {"y", curve.theirs.value}}}});
  return json.dump(1) + "\n";
}

}  // namespace granvof::compare
