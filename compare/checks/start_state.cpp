#include "compare/checks/start_state.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

// Volume [m3] and first moments [m4] of what fills a box in part.
struct Filled {
  double volume = 0.0, along = 0.0, height = 0.0;

  Filled(const Box& box, double share, double deep)
      : volume(share * (box.upper[0] - box.lower[0]) * std::max(box.upper[1] - box.lower[1], 0.0) * deep),
        along(0.5 * volume * (box.lower[0] + box.upper[0])),
        height(0.5 * volume * (box.lower[1] + box.upper[1])) {}
  void take(const Filled& other) {
    volume -= other.volume;
    along -= other.along;
    height -= other.height;
  }
};

using Known = std::vector<std::pair<std::string_view, double>>;

bool on_faces(double length, double spacing) {
  return std::abs(length / spacing - std::round(length / spacing)) < 1e-9;
}

bool is_plain(const Scene& scene) {
  if (!scene.bed || scene.bed->slope != 90.0 || !scene.obstacles.empty() || scene.liquid_boxes.size() != 1)
    return false;
  const Box &bed = scene.bed->box, &liquid = scene.liquid_boxes.front();
  const Vec3& h = scene.grid.spacing;
  return bed.upper[0] < scene.tank[0] && bed.upper[1] < scene.tank[1] && on_faces(bed.lower[0], h[0]) &&
         on_faces(bed.upper[0], h[0]) && on_faces(bed.lower[1], h[1]) && on_faces(bed.upper[1], h[1]) &&
         on_faces(liquid.upper[1], h[1]);
}

// Where a profile that falls from `value` to nothing behind `edge` crosses a threshold, linear between
// centres.
double crossing(double edge, double spacing, double value, double threshold) {
  return edge - 0.5 * spacing + spacing * (value - threshold) / value;
}

Known known(const Scene& scene) {
  const Box& bed = scene.bed->box;
  const double f = scene.bed->solid_fraction, level = scene.liquid_boxes.front().upper[1];
  const double least = scene.contact.solid_fraction_min, h = scene.grid.spacing[0];
  const double wide = scene.tank[2], deep = scene.dimensions == 3 ? bed.upper[2] - bed.lower[2] : wide;
  const double high = bed.upper[1] - bed.lower[1], middle = 0.5 * (bed.lower[1] + bed.upper[1]);
  const double front = crossing(bed.upper[0], h, f, 0.95 * least);

  const Vec3 g = gravity_of(scene);
  const auto energy = [&](const Filled& of, double density) {
    return -density * (g[0] * of.along + g[1] * of.height);
  };
  Box below = bed, above = bed, tank{{0.0, 0.0, 0.0}, scene.tank}, wet = tank;
  below.upper[1] = std::min(bed.upper[1], level);
  above.lower[1] = std::max(bed.lower[1], level);
  wet.upper[1] = level;
  tank.lower[1] = level;
  const Filled grains(bed, f, deep);
  Filled liquid(wet, 1.0, wide), gas(tank, 1.0, wide);
  liquid.take(Filled(below, f, deep));
  gas.take(Filled(above, f, deep));

  Known known{{"front_dense", front},
              {"front_dense_mean", front},
              {"front_dilute", crossing(bed.upper[0], h, f, 0.30)},
              {"front_quantile", std::lerp(bed.lower[0], bed.upper[0], 0.995)},
              {"deposit_height", high * f / least * deep / wide},
              {"y_c", middle},
              {"y_solid_mean", middle},
              {"bed_top", bed.upper[1]},
              {"bed_height", high},
              {"bed_height_equivalent", high},
              {"interface_height", level},
              {"interface_height_outside", level},
              {"liquid_front", scene.tank[0]},
              {"liquid_height_left", level},
              {"liquid_height_right", level},
              {"solid_volume", grains.volume},
              {"liquid_volume", liquid.volume},
              {"f_s_max", f},
              {"potential_energy_solid", energy(grains, scene.solid.density)},
              {"potential_energy_liquid", energy(liquid, scene.liquid.density)},
              {"potential_energy_gas", energy(gas, scene.gas.density)}};
  if (bed.lower[1] > 0.0) known.emplace_back("bed_bottom", bed.lower[1]);
  if (g[0] == 0.0)
    known.emplace_back("p_base", -g[1] * (scene.liquid.density * (level - 0.5 * scene.grid.spacing[1]) +
                                          scene.gas.density * (scene.tank[1] - level)));
  return known;
}

}  // namespace

std::optional<StartDistance> start_distance(const Run& run) {
  if (!is_plain(run.scene)) return std::nullopt;
  StartDistance found;
  for (const auto& [column, value] : known(run.scene)) {
    const Curve curve = run.curve(column);
    if (curve.empty() || curve.time.front() != 0.0) return std::nullopt;
    const double distance = std::abs(curve.value.front() / value - 1.0);
    if (distance <= found.largest) continue;
    found = {distance, std::string(column)};
  }
  return found;
}

}  // namespace granvof::compare
