#include "reference/demvof/element/wall_friction.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/demvof/preparation/settle.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

// Slopes on which a layer speeds up, then slows down [degrees].
constexpr std::array slopes{30.0, 25.0, 20.0, 16.0, 12.0, 8.0, 4.0, 0.0};
constexpr int windows_per_slope = 4;
constexpr double window_time = 4.0;  // sqrt(d/g)
constexpr double slips = 0.2;        // of the lowest beads, sqrt(g d)

double momentum(const PeriodicLayer& layer, const Profile& profile) {
  const LayerSettings& s = layer.settings();
  double sum = 0.0;
  for (std::size_t bin = 0; bin < profile.solid.size(); ++bin)
    sum += profile.solid[bin] * profile.velocity[bin];
  return s.density * s.diameter * sum;
}

}  // namespace

Measured wall_friction(LayerSettings settings) {
  settings.rough_floor = false;
  settings.flows = false;
  PeriodicLayer layer(settings);
  settle(layer.engine(), nearly_still);
  FluidLoad none;  // the drag of the settling
  none.resize(layer.engine().state().count());
  layer.engine().set_load(none);
  const int steps =
      samples_per_window * std::max(1, static_cast<int>(std::lround(window_time * settings.time_unit() /
                                                                    (samples_per_window * settings.dt))));
  const double duration = steps * settings.dt;
  std::vector<double> ratios;
  for (const double slope : slopes) {
    const double angle = slope * std::numbers::pi / 180.0;
    layer.engine().set_gravity(settings.gravity, slope);
    std::vector<Profile> windows;
    for (int w = 0; w < windows_per_slope; ++w) {
      windows.push_back(layer.window(steps));
      granvof::throw_if_stopped();
    }
    for (std::size_t w = 1; w + 1 < windows.size(); ++w) {
      if (windows[w].velocity[0] < slips * std::sqrt(settings.gravity * settings.diameter)) continue;
      const double mass = layer.mass_above(windows[w], 0);
      const double change =
          (momentum(layer, windows[w + 1]) - momentum(layer, windows[w - 1])) / (2.0 * duration);
      ratios.push_back((mass * settings.gravity * std::sin(angle) - change) /
                       (mass * settings.gravity * std::cos(angle)));
    }
  }
  if (ratios.size() < 3) throw std::runtime_error("the layer does not slide on the wall");
  return mean_of(ratios);
}

}  // namespace demvof
