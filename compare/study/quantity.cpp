#include "compare/study/quantity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/input/curves.hpp"
#include "compare/input/uncertainty.hpp"
#include "compare/metrics/run_out.hpp"

namespace granvof::compare {
namespace {

Curve solid_height(const Run& run) {
  return run.curve("y_solid_mean");
}

Curve front(const Run& run) {
  return run.curve("front_dense");
}

// A curve that can be asked for by name.
struct CurveEntry {
  std::string_view name, unit, abscissa;
  Curve (*function)(const Run&);
};

constexpr std::array curves{
    CurveEntry{"run_out", "-", "T", run_out_curve},              // (l - l0) / h0
    CurveEntry{"run_out_dense", "-", "T", run_out_dense_curve},  // the same by f_s >= 0.95 f_s,min
    CurveEntry{"front", "m", "t [s]", front},                    // largest x with f_s >= 0.95 f_s,min
    CurveEntry{"solid_height", "m", "t [s]", solid_height},      // centre of mass of all solids
    CurveEntry{"liquid_front", "-", "t sqrt(2 g / a)", scaled_liquid_front},  // x / a of the water
};

const CurveEntry* find_curve(std::string_view name) {
  const auto* found =
      std::find_if(curves.begin(), curves.end(), [&](const CurveEntry& e) { return e.name == name; });
  return found == curves.end() ? nullptr : found;
}

// Range of a curve in the window; nothing where it has none.
std::optional<double> range_of(const Curve& curve, const std::optional<Window>& window) {
  const Curve seen = window ? clip(curve, *window) : curve;
  const auto high = maximum(seen);
  const auto low = minimum(seen);
  return high && *high > *low ? std::optional(*high - *low) : std::nullopt;
}

std::string allowed() {
  std::vector<std::string_view> names;
  names.reserve(curves.size() + metrics().size());
  for (const CurveEntry& entry : curves) names.push_back(entry.name);
  for (const MetricEntry& entry : metrics()) names.push_back(entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string Quantity::label() const {
  return labelled(name, parameters);
}

std::string_view Quantity::unit() const {
  return is_curve ? find_curve(name)->unit : find_metric(name)->unit;
}

std::string_view Quantity::abscissa() const {
  return find_curve(name)->abscissa;
}

Quantity parse_quantity(std::string_view text, std::optional<Window> window,
                        std::span<const Check> fallback) {
  Quantity quantity;
  const auto at = text.find('@');
  quantity.name = text.substr(0, at);
  quantity.parameters.window = window;
  if (at != std::string_view::npos) {
    const std::string_view number = text.substr(at + 1);
    double value = 0.0;
    const auto parsed = std::from_chars(number.data(), number.data() + number.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != number.data() + number.size() || !std::isfinite(value))
      throw std::invalid_argument(fmt::format("'{}' given; expected NAME or NAME@NUMBER", text));
    quantity.parameters.at = value;
  }
  const MetricEntry* metric = find_metric(quantity.name);
  if (metric && metric->needs.at == quantity.parameters.at.has_value()) {
    if (is_complete(metric->needs, quantity.parameters)) return quantity;
    for (const Check& check : fallback)
      if (check.metric == quantity.name &&
          (!metric->needs.at || check.parameters.at == quantity.parameters.at)) {
        quantity.parameters = check.parameters;
        if (window) quantity.parameters.window = window;
        return quantity;
      }
  }
  if (!quantity.parameters.at && find_curve(quantity.name)) {
    quantity.is_curve = true;
    return quantity;
  }
  if (!metric) throw std::invalid_argument(fmt::format("'{}' given; allowed: {}", text, allowed()));
  throw std::invalid_argument(
      fmt::format("'{}' lacks a parameter of that metric, and the table of checks has no row of the scene to "
                  "take it from; "
                  "give NAME@AT or a window",
                  text));
}

Observed observe(const Quantity& quantity, const Run& run) {
  Observed observed;
  if (quantity.is_curve) {
    observed.curve = find_curve(quantity.name)->function(run);
    if (observed.curve.empty()) observed.note = fmt::format("undefined: the run has no {}", quantity.name);
    return observed;
  }
  const FindRun none = [](std::string_view) -> const Run* { return nullptr; };
  const Measured measured = find_metric(quantity.name)->function(run, quantity.parameters, none);
  observed.note = measured.note;
  if (measured.value && std::isfinite(*measured.value)) observed.value = measured.value;
  return observed;
}

std::optional<double> relative_distance(const Quantity& quantity, const Observed& a, const Observed& b) {
  if (!a.defined() || !b.defined()) return std::nullopt;
  if (!quantity.is_curve) {
    if (*b.value == 0.0) return std::nullopt;
    return std::abs(*a.value - *b.value) / std::abs(*b.value);
  }
  const Window common{std::max(a.curve.time.front(), b.curve.time.front()),
                      std::min(a.curve.time.back(), b.curve.time.back())};
  const Window window = quantity.parameters.window.value_or(common);
  if (!(window.begin < window.end)) return std::nullopt;
  const auto range = range_of(b.curve, window);
  const auto distance = rms_distance(a.curve, b.curve, window);
  if (!distance || !range) return std::nullopt;
  return *distance / *range;
}

std::optional<double> scale_of(const Quantity& quantity, const Observed& observed) {
  if (quantity.is_curve) return range_of(observed.curve, quantity.parameters.window);
  return observed.value ? std::optional(std::abs(*observed.value)) : std::nullopt;
}

std::optional<double> relative_uncertainty(const Quantity& quantity, const Run& record,
                                           const Observed& observed, const Bands& bands) {
  const auto uncertainty = record_uncertainty(quantity.name, record, bands);
  const auto scale = scale_of(quantity, observed);
  if (!uncertainty || !scale || *scale == 0.0) return std::nullopt;
  return *uncertainty / *scale;
}

}  // namespace granvof::compare
