#include "reference/demvof/preparation/settle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

constexpr double relaxation_time = 0.02;  // of the drag [s]
constexpr double longest_settling = 1.5;  // [s]

}  // namespace

double rms_speed(const BeadState& state) {
  double sum = 0.0;
  for (const double v : state.velocity) sum += v * v;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, state.count())));
}

void settle(BeadEngine& engine, double still_share) {
  FluidLoad load;
  load.resize(engine.state().count());
  std::fill(load.coefficient.begin(), load.coefficient.end(), engine.bead_mass() / relaxation_time);
  engine.set_load(load);
  const double still = still_share * std::sqrt(engine.settings().gravity * engine.settings().diameter);
  const int burst = static_cast<int>(std::lround(0.01 / engine.settings().dt));
  const double start = engine.time();
  for (int n = 0; engine.time() - start < longest_settling; ++n) {
    engine.run(burst);
    granvof::throw_if_stopped();
    if (n > 1 && rms_speed(engine.state()) < still) return;
  }
  throw std::runtime_error(fmt::format("the column does not come to rest: {:.3g} m/s after {} s",
                                       rms_speed(engine.state()), longest_settling));
}

}  // namespace demvof
