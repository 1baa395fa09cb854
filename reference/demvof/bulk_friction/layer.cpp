#include "reference/demvof/bulk_friction/layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "reference/demvof/preparation/disperse.hpp"
#include "reference/demvof/preparation/rough_floor.hpp"

namespace demvof {

namespace {

constexpr double start_packing = 0.52;  // of the dispersed beads [-]
constexpr double start_inertia = 0.4;   // inertial number of the first flow, to spare the way there [-]

double lowest(const LayerSettings& s) {
  return s.rough_floor ? 0.7 * s.diameter : 0.0;
}

double top(const LayerSettings& s) {
  return s.diameter * (0.7 + s.layer * rest_packing / start_packing);
}

BeadSettings bead_settings(const LayerSettings& s) {
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

std::vector<double> floor_of(const LayerSettings& s) {
  if (!s.rough_floor) return {};
  return rough_floor({s.length * s.diameter, s.depth * s.diameter, true}, s.diameter, s.seed);
}

BeadState dispersed(const LayerSettings& s) {
  std::mt19937 random(s.seed);
  const double d = s.diameter, volume = std::numbers::pi / 6.0 * d * d * d;
  const Vector lower{0.0, lowest(s), 0.0}, upper{s.length * d, top(s), s.depth * d};
  const double room = upper[0] * (upper[1] - lower[1]) * upper[2];
  const auto count = static_cast<std::size_t>(start_packing * room / volume);
  BeadState beads;
  beads.position = disperse_beads(count, lower, upper, true, d, random);
  beads.velocity.assign(beads.position.size(), 0.0);
  if (!s.flows) return beads;
  // Bagnold's profile of a layer that flows with `start_inertia`.
  const double height = s.layer * d;
  const double rate = start_inertia * std::sqrt(rest_packing * s.gravity) / d;
  for (std::size_t n = 0; n < beads.velocity.size(); n += 3) {
    const double below_top = std::max(0.0, height - beads.position[n + 1]);
    beads.velocity[n] = 2.0 / 3.0 * rate * (std::pow(height, 1.5) - std::pow(below_top, 1.5));
  }
  return beads;
}

}  // namespace

double LayerSettings::time_unit() const {
  return std::sqrt(diameter / gravity);
}

PeriodicLayer::PeriodicLayer(const LayerSettings& s)
    : s_(s),
      engine_(bead_settings(s), dispersed(s), floor_of(s)),
      bins_(static_cast<std::size_t>(engine_.settings().tank[1] / s.diameter)) {}

Profile PeriodicLayer::window(int steps) {
  std::vector<double> number(bins_, 0.0);
  std::array<std::vector<double>, 3> sum, squares;
  for (std::size_t d = 0; d < 3; ++d) {
    sum[d].assign(bins_, 0.0);
    squares[d].assign(bins_, 0.0);
  }
  for (int sample = 0; sample < samples_per_window; ++sample) {
    engine_.run(steps / samples_per_window);
    const BeadState& beads = engine_.state();
    for (std::size_t b = 0; b < beads.count(); ++b) {
      const double height = std::max(0.0, beads.position[3 * b + 1] / s_.diameter);
      const std::size_t bin = std::min(bins_ - 1, static_cast<std::size_t>(height));
      number[bin] += 1.0;
      for (std::size_t d = 0; d < 3; ++d) {
        const double v = beads.velocity[3 * b + d];
        sum[d][bin] += v;
        squares[d][bin] += v * v;
      }
    }
  }
  Profile mean{number, std::vector<double>(bins_, 0.0), std::vector<double>(bins_, 0.0)};
  const double area = s_.length * s_.depth * s_.diameter * s_.diameter;
  const double share = engine_.bead_volume() / (area * s_.diameter * samples_per_window);
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    mean.solid[bin] *= share;
    if (number[bin] == 0.0) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      const double v = sum[d][bin] / number[bin];
      mean.fluctuation[bin] += std::max(0.0, squares[d][bin] / number[bin] - v * v) / 3.0;
    }
    mean.velocity[bin] = sum[0][bin] / number[bin];
  }
  return mean;
}

double PeriodicLayer::mass_above(const Profile& profile, std::size_t edge) const {
  double sum = 0.0;
  for (std::size_t bin = profile.solid.size(); bin-- > edge;) sum += profile.solid[bin];
  return s_.density * s_.diameter * sum;
}

bool PeriodicLayer::counts(const Profile& profile, std::size_t edge) const {
  return static_cast<double>(edge) >= bottom_left_out &&
         mass_above(profile, edge) >= surface_left_out * s_.diameter * rest_packing * s_.density;
}

}  // namespace demvof
