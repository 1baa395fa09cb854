#include "reference/demvof/bulk_friction/chute.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "reference/demvof/beads/bead_engine.hpp"
#include "reference/demvof/preparation/disperse.hpp"
#include "reference/demvof/preparation/rough_floor.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

constexpr double start_packing = 0.52;  // of the dispersed beads [-]
constexpr double rest_packing = 0.58;   // of the layer [-]
constexpr double start_inertia = 0.4;   // inertial number of the first flow, to spare the way there [-]
constexpr int windows_per_stage = 6;    // the first and the last have no acceleration of their own
constexpr int samples_per_window = 10;
constexpr double bottom_left_out = 3.0;   // of the layer, in diameters
constexpr double surface_left_out = 4.0;  // load above a point that counts, in diameters of packed layer
constexpr double at_rest = 0.01;          // rms speed, in sqrt(g d)

// Means over a window, in bins one diameter high.
struct Profile {
  std::vector<double> solid;     // number of beads a sample, then f_s [-]
  std::vector<double> velocity;  // along the chute [m/s]
};

class Chute {
 public:
  explicit Chute(const ChuteSettings& s)
      : s_(s),
        area_(s.length * s.depth * s.diameter * s.diameter),
        engine_(bead_settings(s), layer(s), floor(s)) {
    bins_ = static_cast<std::size_t>(engine_.settings().tank[1] / s.diameter);
  }

  BeadEngine& engine() { return engine_; }

  Profile window(int steps) {
    Profile mean{std::vector<double>(bins_, 0.0), std::vector<double>(bins_, 0.0)};
    for (int sample = 0; sample < samples_per_window; ++sample) {
      engine_.run(steps / samples_per_window);
      const BeadState& beads = engine_.state();
      for (std::size_t b = 0; b < beads.count(); ++b) {
        const double height = std::max(0.0, beads.position[3 * b + 1] / s_.diameter);
        const std::size_t bin = std::min(bins_ - 1, static_cast<std::size_t>(height));
        mean.solid[bin] += 1.0;
        mean.velocity[bin] += beads.velocity[3 * b];
      }
    }
    const double share = engine_.bead_volume() / (area_ * s_.diameter * samples_per_window);
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      if (mean.solid[bin] > 0.0) mean.velocity[bin] /= mean.solid[bin];
      mean.solid[bin] *= share;
    }
    return mean;
  }

  // Mean over the heights that count; nothing without flow. `acceleration` a bin [m/s2].
  std::optional<ChutePoint> point(const Profile& now, const std::vector<double>& acceleration,
                                  double slope) const {
    const double angle = slope * std::numbers::pi / 180.0;
    const double along = s_.gravity * std::sin(angle), down = s_.gravity * std::cos(angle);
    double shear = 0.0, load = 0.0, heights = 0.0, volume = 0.0, flux = 0.0;
    ChutePoint point;
    point.slope = slope;
    for (std::size_t bin = bins_ - 1; bin-- > 1;) {
      const double mass =
          s_.density * now.solid[bin + 1] * s_.diameter;  // of the bin above this edge [kg/m2]
      shear += mass * (along - acceleration[bin + 1]);
      load += mass * down;
      volume += now.solid[bin + 1];
      flux += now.solid[bin + 1] * now.velocity[bin + 1];
      const auto edge = static_cast<double>(bin + 1);
      if (edge < bottom_left_out || load < surface_left_out * s_.diameter * rest_packing * s_.density * down)
        continue;
      const double rate = (now.velocity[bin + 1] - now.velocity[bin]) / s_.diameter;
      point.friction.friction += shear / load;
      point.friction.inertial_number += rate * s_.diameter / std::sqrt(load / s_.density);
      point.solid_fraction += 0.5 * (now.solid[bin] + now.solid[bin + 1]);
      heights += 1.0;
    }
    if (heights == 0.0 || volume == 0.0) return std::nullopt;
    point.friction.friction /= heights;
    point.friction.inertial_number /= heights;
    point.solid_fraction /= heights;
    point.mean_speed = flux / volume;
    return point;
  }

  double rms_speed() const {
    const std::vector<double>& velocity = engine_.state().velocity;
    double sum = 0.0;
    for (const double v : velocity) sum += v * v;
    return std::sqrt(sum / static_cast<double>(engine_.state().count()));
  }

 private:
  ChuteSettings s_;
  double area_;
  BeadEngine engine_;
  std::size_t bins_ = 0;

  static double top(const ChuteSettings& s) {
    return s.diameter * (0.7 + s.layer * rest_packing / start_packing);
  }
  static BeadSettings bead_settings(const ChuteSettings& s) {
    BeadSettings b;
    b.tank = {s.length * s.diameter, 2.0 * top(s), s.depth * s.diameter};
    b.periodic_depth = b.periodic_length = true;
    b.diameter = s.diameter;
    b.density = s.density;
    b.law = s.law;
    b.dt = s.dt;
    b.gravity = s.gravity;
    b.scratch_folder = s.scratch_folder;
    return b;
  }
  static std::vector<double> floor(const ChuteSettings& s) {
    return rough_floor({s.length * s.diameter, s.depth * s.diameter, true}, s.diameter, s.seed);
  }
  static BeadState layer(const ChuteSettings& s) {
    std::mt19937 random(s.seed);
    const double d = s.diameter, volume = std::numbers::pi / 6.0 * d * d * d;
    const Vector lower{0.0, 0.7 * d, 0.0}, upper{s.length * d, top(s), s.depth * d};
    const double room = upper[0] * (upper[1] - lower[1]) * upper[2];
    const auto count = static_cast<std::size_t>(start_packing * room / volume);
    BeadState beads;
    beads.position = disperse_beads(count, lower, upper, true, d, random);
    // Bagnold's profile of a layer that flows with `start_inertia`.
    const double height = s.layer * d;
    const double rate = start_inertia * std::sqrt(rest_packing * s.gravity) / d;
    beads.velocity.assign(beads.position.size(), 0.0);
    for (std::size_t n = 0; n < beads.velocity.size(); n += 3) {
      const double below_top = std::max(0.0, height - beads.position[n + 1]);
      beads.velocity[n] = 2.0 / 3.0 * rate * (std::pow(height, 1.5) - std::pow(below_top, 1.5));
    }
    return beads;
  }
};

}  // namespace

ChuteResult run_chute(const ChuteSettings& s) {
  Chute chute(s);
  ChuteResult result;
  result.beads = chute.engine().state().count();
  const int steps =
      samples_per_window *
      static_cast<int>(std::lround(s.stage_time / (windows_per_stage * samples_per_window * s.dt)));
  const double duration = steps * s.dt, still = at_rest * std::sqrt(s.gravity * s.diameter);
  for (const double slope : s.slopes) {
    chute.engine().set_gravity(s.gravity, slope);
    std::vector<Profile> windows;
    windows.reserve(windows_per_stage);
    const double begin = chute.engine().time();
    for (int w = 0; w < windows_per_stage; ++w) {
      windows.push_back(chute.window(steps));
      granvof::throw_if_stopped();
    }
    for (std::size_t w = 1; w + 1 < windows.size(); ++w) {
      std::vector<double> acceleration(windows[w].velocity.size());
      for (std::size_t bin = 0; bin < acceleration.size(); ++bin) {
        acceleration[bin] = (windows[w + 1].velocity[bin] - windows[w - 1].velocity[bin]) / (2.0 * duration);
      }
      std::optional<ChutePoint> point = chute.point(windows[w], acceleration, slope);
      if (!point || point->mean_speed < still) continue;
      point->time = begin + (static_cast<double>(w) + 0.5) * duration;
      result.points.push_back(*point);
    }
    if (chute.rms_speed() < still) {
      result.stopped_at = slope;
      break;
    }
    result.lowest_flow = slope;
  }
  result.duration = chute.engine().time();
  return result;
}

}  // namespace demvof
