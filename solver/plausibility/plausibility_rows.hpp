// Rows of the table of plausibility: a key, and what is said of its value in a scene.
#pragma once

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
template <class Value, class Range, class Reason>
Row row(const std::string& key, const std::string& unit, Value value, Range range, Reason reason) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            const Number x = value(scene);
            if (!x) return std::nullopt;
            Usual usual;
            if constexpr (std::is_same_v<Range, Usual>) {
              usual = range;
            } else {
              usual = range(scene);
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

// A parameter of a choice that is not made: at its default nobody asked for it.
template <class Value, class Used>
Row idle(const std::string& key, Value value, Used used, const std::string& without) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            if (used(scene) || value(scene.contact) == value(Contact{})) return std::nullopt;
            return Implausible{key, fmt::format("{}", value(scene.contact)), "its default",
                               "it has no effect without " + without};
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

// Of [contact]; the others stand with the table.
std::vector<Row> contact_rows();

}  // namespace granvof::plausible
