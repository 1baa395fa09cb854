#include "reference/demvof/preparation/column.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "reference/demvof/beads/bead_engine.hpp"
#include "reference/demvof/preparation/disperse.hpp"
#include "reference/demvof/preparation/settle.hpp"

namespace demvof {

namespace {

constexpr double start_packing = 0.52;  // of the dispersed beads before they settle [-]
constexpr double surplus = 1.10;        // beads taken more than the column needs; cut off at the end

double bead_volume(double diameter) {
  return std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

}  // namespace

double packing_inside(const std::vector<double>& position, const Vector& lower, const Vector& upper,
                      double diameter) {
  std::size_t inside = 0;
  for (std::size_t n = 0; n + 2 < position.size(); n += 3) {
    bool in = true;
    for (std::size_t d = 0; d < 3; ++d) in = in && position[n + d] >= lower[d] && position[n + d] < upper[d];
    inside += in ? 1 : 0;
  }
  const double volume = (upper[0] - lower[0]) * (upper[1] - lower[1]) * (upper[2] - lower[2]);
  return static_cast<double>(inside) * bead_volume(diameter) / volume;
}

Column prepare_column(const ColumnSettings& s) {
  const double d = s.diameter;
  const double length = s.upper[0] - s.lower[0], height = s.upper[1] - s.lower[1],
               depth = s.upper[2] - s.lower[2];
  const double volume = length * height * depth;
  const double wanted = s.packing * volume / bead_volume(d);
  const auto count = static_cast<std::size_t>(std::lround(s.suspended ? wanted : surplus * wanted));
  std::mt19937 random(s.seed);

  // The preparation has a tank of its own, with the column's corner at the origin.
  BeadSettings engine_settings;
  const double bottom = s.floor.empty() ? 0.0 : 0.7 * d;
  const double top_of_gas =
      s.suspended ? height
                  : bottom + static_cast<double>(count) * bead_volume(d) / (start_packing * length * depth);
  BeadState gas;
  gas.position =
      disperse_beads(count, {0.0, bottom, 0.0}, {length, top_of_gas, depth}, s.periodic_depth, d, random);
  engine_settings.tank = {length, top_of_gas + d, depth};
  engine_settings.periodic_depth = s.periodic_depth;
  engine_settings.diameter = d;
  engine_settings.density = s.density;
  engine_settings.law = s.preparation_law;
  engine_settings.dt = s.dt;
  engine_settings.gravity = 0.0;
  engine_settings.scratch_folder = s.scratch_folder;
  std::vector<double> floor;
  for (std::size_t n = 0; n + 2 < s.floor.size(); n += 3) {
    const double x = s.floor[n] - s.lower[0];
    // Also those that reach under the column from beside it: it must not stand in them when the gate is
    // closed.
    // Those of obstacles are at their heights.
    const double y = s.floor[n + 1] - s.lower[1];
    if (x > -d && x < length + d && std::abs(y) < d)
      floor.insert(floor.end(), {x, y, s.floor[n + 2] - s.lower[2]});
  }

  Column column;
  std::vector<double> settled = gas.position;
  if (!s.suspended) {
    BeadEngine engine(engine_settings, gas, floor);
    engine.set_gravity(s.buoyant_gravity);
    settle(engine, nearly_still);
    if (s.final_settling) {
      engine.set_contact_law(s.final_law);
      settle(engine, quite_still);
    }
    column.residual_speed = rms_speed(engine.state());
    settled = engine.state().position;
  }
  double filled = 0.0, top = 0.0;
  for (std::size_t n = 0; n + 2 < settled.size(); n += 3) {
    filled = std::max(filled, settled[n + 1] + 0.5 * d);
    if (!s.suspended && settled[n + 1] > height - 0.5 * d) continue;
    top = std::max(top, settled[n + 1] + 0.5 * d);
    for (std::size_t k = 0; k < 3; ++k) column.position.push_back(settled[n + k] + s.lower[k]);
  }
  if (filled < height - 0.5 * d) {
    throw std::runtime_error(
        fmt::format("the beads settled to {:.4g} m of the wanted {:.4g} m; the packing of the "
                    "preparation exceeds the wanted one by more than {:.0f} %",
                    filled, height, 100.0 * (surplus - 1.0)));
  }
  column.height = top;
  const double edge = 3.0 * d, across = s.periodic_depth ? 0.0 : edge;
  const bool room = length > 4.0 * edge && height > 4.0 * edge;
  const double margin = room ? edge : 0.0;
  column.packing =
      packing_inside(column.position, {s.lower[0] + margin, s.lower[1] + margin, s.lower[2] + across},
                     {s.upper[0] - margin, s.upper[1] - margin, s.upper[2] - across}, d);
  return column;
}

}  // namespace demvof
