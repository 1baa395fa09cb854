// What a study looks at: one metric with its parameters, or one curve, and the error of either.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compare/checks/check.hpp"
#include "compare/checks/registry.hpp"
#include "compare/input/bands.hpp"
#include "compare/input/run.hpp"

namespace granvof::compare {

struct Quantity {
  std::string name;       // of the metric or curve
  Parameters parameters;  // window: of the curve, or as the metric takes it
  bool is_curve = false;
  // "run_out@10"
  std::string label() const;
  std::string_view unit() const;      // "-" for none
  std::string_view abscissa() const;  // of a curve, with its unit: "T", "t [s]"
};

// From "NAME" or "NAME@AT": a metric where the registry has NAME and all it needs is given, else a curve.
// Where a metric still lacks a parameter, `fallback` (the rows of the table of checks of that scene) is
// asked. Throws std::invalid_argument, saying what is allowed.
Quantity parse_quantity(std::string_view text, std::optional<Window> window,
                        std::span<const Check> fallback = {});

struct Observed {
  std::optional<double> value;  // of a metric
  Curve curve;                  // of a curve
  std::string note;             // why there is neither
  bool defined() const { return value.has_value() || !curve.empty(); }
};

Observed observe(const Quantity& quantity, const Run& run);

// Relative distance [-], >= 0: |a - b| / |b| of values; of curves the rms of the difference over the window
// (default: the part of the abscissa that both cover), over the range of b in it. Nothing where one is
// undefined, does not cover the window, or b's magnitude or range is 0.
std::optional<double> relative_distance(const Quantity& quantity, const Observed& a, const Observed& b);

// What relative_distance() is relative to: a value's magnitude, a curve's range in the window. Nothing where
// it has none.
std::optional<double> scale_of(const Quantity& quantity, const Observed& observed);

// The uncertainty of a record (input/uncertainty.hpp), relative as relative_distance() is [-].
std::optional<double> relative_uncertainty(const Quantity& quantity, const Run& record,
                                           const Observed& observed, const Bands& bands);

}  // namespace granvof::compare
