#include "reference/demvof/element/cooling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "reference/demvof/preparation/disperse.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

constexpr double gas_fraction = 0.2;   // [-]
constexpr double height = 20.0;        // between the planes, in diameters
constexpr double first_speed = 1.0;    // sqrt(Theta), in sqrt(g d)
constexpr int repeats = 5;             // seeds
constexpr double until_spun_up = 4.0;  // collisions of a bead before the line begins
// At its end: later neighbours move alike, which no longer dissipates.
constexpr double collisions = 12.0;
constexpr double samples_per_collision = 5.0;

double contact_value() {  // g0 of Carnahan and Starling
  return (1.0 - 0.5 * gas_fraction) / std::pow(1.0 - gas_fraction, 3);
}

double temperature(const BeadState& beads) {
  double squares = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    double sum = 0.0;
    for (std::size_t n = d; n < beads.velocity.size(); n += 3) sum += beads.velocity[n];
    const double mean = sum / static_cast<double>(beads.count());
    for (std::size_t n = d; n < beads.velocity.size(); n += 3)
      squares += (beads.velocity[n] - mean) * (beads.velocity[n] - mean);
  }
  return squares / (3.0 * static_cast<double>(beads.count()));
}

double restitution_of_seed(const LayerSettings& s, unsigned seed) {
  std::mt19937 random(seed);
  const double d = s.diameter, volume = std::numbers::pi / 6.0 * d * d * d;
  BeadSettings b;
  b.tank = {s.length * d, height * d, s.depth * d};
  b.periodic_depth = b.periodic_length = true;
  b.diameter = d;
  b.density = s.density;
  b.law = s.law;
  b.law.wall_friction = 0.0;
  b.dt = s.dt;
  b.gravity = 0.0;
  b.scratch_folder = s.scratch_folder;
  const auto count = static_cast<std::size_t>(gas_fraction * b.tank[0] * b.tank[1] * b.tank[2] / volume);
  BeadState beads;
  beads.position = disperse_beads(count, {0.0, 0.0, 0.0}, b.tank, true, d, random);
  std::normal_distribution<double> speed(0.0, first_speed * std::sqrt(s.gravity * d));
  for (std::size_t n = 0; n < beads.position.size(); ++n) beads.velocity.push_back(speed(random));
  BeadEngine engine(b, beads, {});

  const double rate = gas_fraction * contact_value() / (std::sqrt(std::numbers::pi) * d);  // over sqrt(Theta)
  double met = 0.0, n = 0.0, st = 0.0, sy = 0.0, stt = 0.0, sty = 0.0;
  double theta = temperature(engine.state());
  while (met < collisions) {
    const double every = 1.0 / (samples_per_collision * 24.0 * rate * std::sqrt(theta));
    const int steps = std::max(1, static_cast<int>(std::lround(every / s.dt)));
    engine.run(steps);
    granvof::throw_if_stopped();
    theta = temperature(engine.state());
    met += 24.0 * rate * std::sqrt(theta) * steps * s.dt;
    if (met < until_spun_up) continue;
    const double t = engine.time(), y = 1.0 / std::sqrt(theta);
    n += 1.0;
    st += t;
    sy += y;
    stt += t * t;
    sty += t * y;
  }
  const double slope = (n * sty - st * sy) / (n * stt - st * st);
  return std::sqrt(std::max(0.0, 1.0 - slope / (4.0 * rate)));
}

}  // namespace

Measured cooling_restitution(const LayerSettings& settings) {
  std::vector<double> found;
  for (int repeat = 0; repeat < repeats; ++repeat)
    found.push_back(restitution_of_seed(settings, settings.seed + static_cast<unsigned>(repeat)));
  return mean_of(found);
}

}  // namespace demvof
