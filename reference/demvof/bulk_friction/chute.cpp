#include "reference/demvof/bulk_friction/chute.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/demvof/preparation/settle.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

constexpr int windows_per_stage = 6;     // the first and the last have no acceleration of their own
constexpr double at_rest = 0.01;         // rms speed, in sqrt(g d)
constexpr double flows_again = 0.1;      // likewise: far above what a layer at rest creeps with
constexpr double step_of_start = 0.5;    // of the slope on the way up [degrees]
constexpr double steepest_start = 40.0;  // [degrees]

// From rest upwards; half a stage a slope.
std::optional<double> start_of(PeriodicLayer& layer, double from, int stage_steps) {
  const LayerSettings& s = layer.settings();
  const double flowing = flows_again * std::sqrt(s.gravity * s.diameter);
  for (double slope = from; slope <= steepest_start; slope += step_of_start) {
    layer.engine().set_gravity(s.gravity, slope);
    layer.engine().run(stage_steps / 2);
    granvof::throw_if_stopped();
    if (rms_speed(layer.engine().state()) > flowing) return slope;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ChutePoint> chute_point(const PeriodicLayer& layer, const Profile& now,
                                      const std::vector<double>& acceleration, double slope) {
  const LayerSettings& s = layer.settings();
  const double angle = slope * std::numbers::pi / 180.0, d = s.diameter;
  const double along = s.gravity * std::sin(angle), down = s.gravity * std::cos(angle);
  double shear = 0.0, load = 0.0, heights = 0.0, volume = 0.0, flux = 0.0;
  ChutePoint point;
  point.slope = slope;
  for (std::size_t edge = now.solid.size() - 1; edge > 1; --edge) {
    const double mass = s.density * now.solid[edge] * d;  // of the bin above this edge [kg/m2]
    shear += mass * (along - acceleration[edge]);
    load += mass * down;
    volume += now.solid[edge];
    flux += now.solid[edge] * now.velocity[edge];
    if (!layer.counts(now, edge)) continue;
    const double rate = (now.velocity[edge] - now.velocity[edge - 1]) / d;
    point.friction.friction += shear / load;
    point.friction.inertial_number += rate * d / std::sqrt(load / s.density);
    point.solid_fraction += 0.5 * (now.solid[edge - 1] + now.solid[edge]);
    point.load += load;
    // A rate of shear spreads the velocity along the slope by (rate d)^2 / 12 in a bin: a third of it a
    // component.
    const double spread = 0.5 * (now.fluctuation[edge - 1] + now.fluctuation[edge]);
    point.temperature += rate == 0.0 ? 0.0 : std::max(0.0, spread / (rate * rate * d * d) - 1.0 / 36.0);
    heights += 1.0;
  }
  if (heights == 0.0 || volume == 0.0) return std::nullopt;
  for (double* mean : {&point.friction.friction, &point.friction.inertial_number, &point.solid_fraction,
                       &point.load, &point.temperature})
    *mean /= heights;
  point.mean_speed = flux / volume;
  return point;
}

std::vector<double> acceleration_between(const Profile& before, const Profile& after, double time) {
  std::vector<double> acceleration(before.velocity.size());
  for (std::size_t bin = 0; bin < acceleration.size(); ++bin)
    acceleration[bin] = (after.velocity[bin] - before.velocity[bin]) / time;
  return acceleration;
}

ChuteResult run_chute(const ChuteSettings& s) {
  PeriodicLayer layer(s);
  ChuteResult result;
  result.beads = layer.engine().state().count();
  const int steps =
      samples_per_window *
      static_cast<int>(std::lround(s.stage_time / (windows_per_stage * samples_per_window * s.dt)));
  const double duration = steps * s.dt, still = at_rest * std::sqrt(s.gravity * s.diameter);
  for (const double slope : s.slopes) {
    layer.engine().set_gravity(s.gravity, slope);
    std::vector<Profile> windows;
    windows.reserve(windows_per_stage);
    const double begin = layer.engine().time();
    for (int w = 0; w < windows_per_stage; ++w) {
      windows.push_back(layer.window(steps));
      granvof::throw_if_stopped();
    }
    for (std::size_t w = 1; w + 1 < windows.size(); ++w) {
      const std::vector<double> acceleration =
          acceleration_between(windows[w - 1], windows[w + 1], 2.0 * duration);
      std::optional<ChutePoint> point = chute_point(layer, windows[w], acceleration, slope);
      if (!point || point->mean_speed < still) continue;
      point->time = begin + (static_cast<double>(w) + 0.5) * duration;
      result.points.push_back(*point);
    }
    if (rms_speed(layer.engine().state()) < still) {
      result.stopped_at = slope;
      break;
    }
    result.lowest_flow = slope;
  }
  result.duration = layer.engine().time();
  if (s.find_start && result.stopped_at) {
    result.started_at = start_of(layer, *result.stopped_at + step_of_start, steps * windows_per_stage);
  }
  return result;
}

}  // namespace demvof
