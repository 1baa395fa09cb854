#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"
#include "solver/scene/regular_times.hpp"
#include "solver/scene/scales.hpp"

namespace granvof::case_file {
namespace {

constexpr double most_rows = 1e6;  // of series.csv
constexpr double most_field_times = 1e4;
constexpr double most_steps = 1e9;      // of the longest: years on the smallest grid
constexpr double longest_step = 0.07;   // default, in times of the scene
constexpr double shortest_step = 2e-7;  // default, in longest steps

void unit(const Completion& c) {
  if (c.d.times.unit != TimeUnit::column) return;
  if (!c.has("bed") || c.s.gravity == 0.0)
    c.refuse("time.unit", R"("s"; "column" needs a [bed] and gravity)");
  c.s.times.unit = std::sqrt(c.d.bed.height / c.s.gravity);
}

void lengths(const Completion& c) {
  c.s.times.end = c.d.times.end * c.s.times.unit;
  c.s.times.hold = c.d.times.hold;
}

void step_order(const Completion& c) {
  const Numerics& n = c.s.numerics;
  if (n.dt_min > n.dt_max)
    c.refuse("numerics.dt_min", fmt::format("at most numerics.dt_max = {} s", n.dt_max));
}

// Steps that the case leaves out follow from the time of its scene.
void steps(const Completion& c) {
  Numerics& n = c.s.numerics;
  if (!c.given("numerics.dt_max")) n.dt_max = longest_step * scales_of(c.s).time();
  if (!c.given("numerics.dt_min")) n.dt_min = shortest_step * n.dt_max;
  step_order(c);
  const double longest = most_steps * n.dt_max;
  if (c.s.times.end > longest) {
    c.refuse("time.end", fmt::format("at most {:.6g}, {:g} steps of numerics.dt_max",
                                     longest / c.s.times.unit, most_steps));
  }
  if (c.s.times.hold > longest) {
    c.refuse("time.hold",
             fmt::format("at most {:.6g} s, {:g} steps of numerics.dt_max", longest, most_steps));
  }
}

void rows(const Completion& c) {
  TimesInput& t = c.d.times;
  const double interval = *(t.series_interval = t.series_interval.value_or(t.end / 200.0));
  if (interval > t.end || t.end / interval > most_rows) {
    c.refuse("output.series_interval", fmt::format("a number in [{:.9g}, {:.9g}], time.end / {} to time.end",
                                                   t.end / most_rows, t.end, most_rows));
  }
  for (const double time : regular_times(interval, t.end))
    c.s.times.row_times.push_back(time * c.s.times.unit);
  c.s.times.checkpoint_interval = t.checkpoint_interval;
}

void fields(const Completion& c) {
  TimesInput& t = c.d.times;
  const int listed = c.layer_of("output.field_times");
  const int spaced = c.layer_of("output.field_interval");
  if (listed >= 0 && listed == spaced)
    c.refuse("output.field_interval", "either field_times or field_interval");
  if (spaced > listed) {
    if (*t.field_interval > t.end || t.end / *t.field_interval > most_field_times) {
      c.refuse("output.field_interval", fmt::format("a number in [{:.9g}, {:.9g}], time.end / {} to time.end",
                                                    t.end / most_field_times, t.end, most_field_times));
    }
    t.field_times = regular_times(*t.field_interval, t.end);
  } else if (listed < 0) {
    t.field_times = {0.0};
  } else {
    if (std::ranges::adjacent_find(t.field_times, std::greater_equal<>()) != t.field_times.end()) {
      c.refuse("output.field_times", "times in ascending order, each once");
    }
    if (c.layer_of("time.end") > listed)
      std::erase_if(t.field_times, [&](double time) { return time > t.end; });
    if (!t.field_times.empty() && t.field_times.back() > t.end) {
      c.refuse("output.field_times", fmt::format("times in [0, {}], up to time.end", t.end));
    }
  }
  t.field_interval.reset();
  if (t.field_times.empty() || t.field_times.back() < t.end) t.field_times.push_back(t.end);
  for (const double time : t.field_times) c.s.times.field_times.push_back(time * c.s.times.unit);
}

}  // namespace

void complete_times(Completion& c) {
  c.rule({"time.unit", "tank.gravity", "bed.height"}, [&] { unit(c); });
  c.rule({"time", "tank.gravity", "bed.height"}, [&] { lengths(c); });
  if (c.given("numerics.dt_min") && c.given("numerics.dt_max"))
    c.rule({"numerics.dt_min", "numerics.dt_max"}, [&] { step_order(c); });
  c.rule({"time", "tank", "walls", "liquid", "bed", "numerics.dt_min", "numerics.dt_max"}, [&] { steps(c); });
  c.rule({"time.end", "output.series_interval"}, [&] { rows(c); });
  c.rule({"time.end", "output.field_times", "output.field_interval"}, [&] { fields(c); });
}

}  // namespace granvof::case_file
