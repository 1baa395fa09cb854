// Rows of the table of plausibility: a key, and what is said of its value in a scene.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "solver/plausibility/plausibility.hpp"

namespace granvof::plausible {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double steepest = 1.5;  // tan of 56 degrees: no dry grains rest on a steeper slope [-]

using Number = std::optional<double>;  // none: the scene has no such thing, or 0 switches it off
struct Usual {
  double lower = 0.0, upper = infinity;
};
struct Row {
  std::string key;
  std::function<std::optional<Implausible>(const Scene&)> look;
};

inline std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + unit;
}

inline std::string text_of(const Usual& usual, const std::string& unit) {
  std::string text = fmt::format("{:.3g} to {:.3g}", usual.lower, usual.upper);
  if (usual.upper == infinity) text = fmt::format("at least {:.3g}", usual.lower);
  if (usual.lower == 0.0) text = fmt::format("at most {:.3g}", usual.upper);
  if (usual.lower > usual.upper)
    return fmt::format("none, which would be {} and {}",
                       with_unit(fmt::format("at least {:.3g}", usual.lower), unit),
                       with_unit(fmt::format("at most {:.3g}", usual.upper), unit));
  return with_unit(text, unit);
}

// A value against a range, either of which the scene may decide.
template <class Value, class Expected, class Reason>
Row row(const std::string& key, const std::string& unit, Value value, Expected expected, Reason reason) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            const Number x = value(scene);
            if (!x) return std::nullopt;
            Usual usual;
            if constexpr (std::is_same_v<Expected, Usual>) {
              usual = expected;
            } else {
              usual = expected(scene);
            }
            if (*x >= usual.lower && *x <= usual.upper) return std::nullopt;
            std::string why;
            if constexpr (std::is_invocable_v<Reason, const Scene&>) {
              why = reason(scene);
            } else {
              why = reason;
            }
            return Implausible{key, with_unit(fmt::format("{:.9g}", *x), unit), text_of(usual, unit), why};
          }};
}

// A part that is described, but stands nowhere in the scene.
template <class Idle>
Row missing(const std::string& key, Idle is_missing, const std::string& usual, const std::string& reason) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            if (!is_missing(scene)) return std::nullopt;
            return Implausible{key, "nothing", usual, reason};
          }};
}

// --- what the scene's parts give -----------------------------------------------------------------------

inline Number positive(double x) {
  return x > 0.0 ? Number(x) : std::nullopt;
}
inline Number if_bed(const Scene& s, double x) {
  return s.bed ? Number(x) : std::nullopt;
}
inline Number if_liquid(const Scene& s, double x) {
  return s.liquid_boxes.empty() ? std::nullopt : Number(x);
}
inline Number if_gate(const Scene& s, double x) {
  return s.gate ? Number(x) : std::nullopt;
}
inline double extent(const Box& box, int axis) {
  return box.upper[axis] - box.lower[axis];
}
inline double bed_height(const Scene& s) {
  return s.bed ? extent(s.bed->box, 1) : infinity;
}

inline double shortest_of_bed(const Scene& s) {
  double shortest = infinity;
  for (int axis = 0; axis < s.dimensions; ++axis) shortest = std::min(shortest, extent(s.bed->box, axis));
  return shortest;
}

inline double smallest_cell(const Scene& s) {
  return *std::min_element(s.grid.spacing.begin(), s.grid.spacing.begin() + s.dimensions);
}

// --- ranges that several tables share --------------------------------------------------------------------

inline constexpr double off_a_face = 1e-6;  // from how much on, in cells: rounding of lengths in a case file
inline constexpr Usual of_grains{1e-5, 0.1};  // their diameter [m]
// A diameter that is no grain's says nothing about cells, bed or steps.
inline bool is_grain(const Scene& s) {
  return s.solid.diameter >= of_grains.lower && s.solid.diameter <= of_grains.upper;
}
inline constexpr Usual of_friction{0.0, steepest};    // coefficients [-]
inline constexpr Usual of_restitution{0.05, 0.99};    // [-]
inline constexpr Usual of_random_packing{0.5, 0.74};  // of spheres, up to a crystal [-]
inline constexpr double stiffest = 1e12;              // diamond [Pa]
inline constexpr double shortest_step = 1e-6;  // in times of the scene: below it no scheme of first order in
                                               // time gains a digit
inline constexpr double longest_hold = 1e3;    // likewise
// Of a step of the flow [s], none where the scene has no such key.
Row flow_step_row(const std::string& key, const std::function<Number(const Scene&)>& step);

// Of [contact] and of [reference]; the others stand with the table.
std::vector<Row> bed_rows();
std::vector<Row> contact_rows();
std::vector<Row> reference_rows();

// Keys that say something beside what they are without being stated, but act on nothing in the scene.
std::vector<Implausible> idle_keys(const Scene& scene);

}  // namespace granvof::plausible
