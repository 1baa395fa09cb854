#include "reference/demvof/element/first_flow.hpp"

#include <algorithm>
#include <cmath>

#include "reference/demvof/preparation/settle.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

constexpr double lowest_slope = 16.0, steepest = 40.0, step = 0.5;  // [degrees]
constexpr double time_of_slope = 8.0;                               // sqrt(d/g)
constexpr double time_of_window = 2.0;                              // likewise
constexpr double flows = 0.1;                                       // rms speed, sqrt(g d)
constexpr double fast_slope = 34.0;                                 // [degrees]
constexpr double fastest = 0.6;                                     // inertial number
constexpr int most_windows = 80;                                    // a slope

}  // namespace

FirstFlow first_flow(LayerSettings settings, const ContactLaw& preparation) {
  const ContactLaw law = settings.law;
  settings.law = preparation;
  settings.flows = false;
  PeriodicLayer layer(settings);
  settle(layer.engine(), nearly_still);
  layer.engine().set_contact_law(law);
  settle(layer.engine(), quite_still);
  FluidLoad none;  // the drag of the settling
  none.resize(layer.engine().state().count());
  layer.engine().set_load(none);

  const double flowing = flows * std::sqrt(settings.gravity * settings.diameter);
  const auto steps = [&](double time) {
    const double bursts = time * settings.time_unit() / (samples_per_window * settings.dt);
    return samples_per_window * std::max(1, static_cast<int>(std::lround(bursts)));
  };
  FirstFlow result;
  for (double slope = lowest_slope; slope <= steepest && !result.started_at; slope += step) {
    layer.engine().set_gravity(settings.gravity, slope);
    layer.engine().run(steps(time_of_slope));
    granvof::throw_if_stopped();
    if (rms_speed(layer.engine().state()) > flowing) result.started_at = slope;
  }
  const int window = steps(time_of_window);
  const double duration = window * settings.dt;
  double strain = 0.0, inertia = 0.0;
  for (const double slope : {first_slope, fast_slope}) {
    layer.engine().set_gravity(settings.gravity, slope);
    std::vector<Profile> last;
    for (int w = 0; w < most_windows; ++w) {
      if (slope == first_slope ? strain >= largest_strain : inertia >= fastest) break;
      last.push_back(layer.window(window));
      granvof::throw_if_stopped();
      if (last.size() < 3) continue;
      std::optional<ChutePoint> point =
          chute_point(layer, last[1], acceleration_between(last[0], last[2], 2.0 * duration), slope);
      last.erase(last.begin());
      if (!point) continue;
      inertia = point->friction.inertial_number;
      strain += inertia * std::sqrt(point->load / settings.density) / settings.diameter * duration;
      point->time = layer.engine().time() - 1.5 * duration;
      result.points.push_back(*point);
      result.strain.push_back(strain);
    }
  }
  return result;
}

}  // namespace demvof
