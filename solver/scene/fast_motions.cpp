#include "solver/scene/fast_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/scene/gravity.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double off = 1e-9;  // of the tank: rounding of lengths

// Measured in runs. A collapse has come down by six times sqrt(H / g). Gas gets out of the way of a liquid
// that falls through it at two to three times its speed, of grains at up to twice; what has fallen splashes
// about for as long again and more.
constexpr double times_of_collapse = 6.0;  // sqrt(H / g)
constexpr double late_bed = 0.25;          // of sqrt(g H)
constexpr double late_liquid = 0.5;        // of sqrt(2 g H)
constexpr double gas_beside_liquid = 2.5, gas_beside_grains = 1.5;
constexpr double times_of_fall = 3.0, late_fall = 0.3;
constexpr double share_of_wall = 0.75;       // that the cells beside a moving wall have of its speed
constexpr double between_rough_walls = 1.5;  // fastest over mean speed of a channel
constexpr double between_slip_walls = 1.2;

double extent(const Box& box, int d) {
  return box.upper[d] - box.lower[d];
}

bool overlap(const Scene& s, const Box& a, const Box& b, int d) {
  const double least = off * s.tank[d];
  return std::min(a.upper[d], b.upper[d]) - std::max(a.lower[d], b.lower[d]) > least;
}

bool covers(const Scene& s, const Box& over, const Box& box, int d) {
  return over.lower[d] <= box.lower[d] + off * s.tank[d] && over.upper[d] >= box.upper[d] - off * s.tank[d];
}

bool spans_floor(const Scene& s, const Box& box) {
  const Box tank{{}, s.tank};
  return covers(s, box, tank, 0) && (s.dimensions == 2 || covers(s, box, tank, 2));
}

// How far a box may fall onto what lies under all of it [m].
double clearance(const Scene& s, const Box& box) {
  double support = 0.0;
  const auto hold = [&](const Box& other) {
    const bool under = other.upper[1] <= box.lower[1] + off * s.tank[1];
    if (under && covers(s, other, box, 0) && (s.dimensions == 2 || covers(s, other, box, 2)))
      support = std::max(support, other.upper[1]);
  };
  for (const Box& other : s.obstacles) hold(other);
  for (const Box& other : s.liquid_boxes) hold(other);
  if (s.bed) hold(s.bed->box);
  const double free = box.lower[1] - support;
  return free > off * s.tank[1] ? free : 0.0;
}

bool is_immersed(const Scene& s, const Box& box) {
  return std::ranges::any_of(s.liquid_boxes, [&](const Box& liquid) {
    return overlap(s, liquid, box, 0) && overlap(s, liquid, box, 1) &&
           (s.dimensions == 2 || overlap(s, liquid, box, 2));
  });
}

// Fastest of a layer of liquid that its viscosity lets run over a floor [m/s].
double film_speed(const Scene& s, double acceleration, double height) {
  if (s.liquid.viscosity == 0.0) return forever;
  return 0.5 * s.liquid.density * acceleration * height * height / s.liquid.viscosity;
}

Motion steady(double speed) {
  return {.speed = speed, .lasts = forever};
}

Motion fall(double g, double height, double gas) {
  const double time = std::sqrt(2.0 * height / g), speed = g * time;
  return {gas * g, time, speed, times_of_fall * time, late_fall * speed};
}

// Down the floor of an inclined tank, from the body's lower end to the tank's; around a periodic one for
// ever.
void add_slide(const Scene& s, const Box& box, bool is_liquid, std::vector<Motion>& all) {
  const double angle = std::fabs(s.inclination) * std::numbers::pi / 180.0;
  const double friction = is_liquid ? 0.0 : s.solid.friction;
  const double g = s.gravity * (std::sin(angle) - friction * std::cos(angle));
  if (s.inclination == 0.0 || g <= 0.0) return;
  const double most = is_liquid ? film_speed(s, g, extent(box, 1)) : forever;
  if (s.sides[left].kind == SideKind::periodic) {
    const double speed = std::min(g * s.times.end, most);
    all.push_back({g, speed / g, speed, forever, 0.0});
    return;
  }
  const double way = s.inclination > 0.0 ? s.tank[0] - box.upper[0] : box.lower[0];
  if (way <= off * s.tank[0]) return;
  Motion motion = fall(g, way, 1.0);
  if (motion.speed > most) motion = steady(most);
  all.push_back(motion);
}

void add_liquid(const Scene& s, const Box& box, std::vector<Motion>& all) {
  const double g = normal_gravity(s), high = extent(box, 1), free = clearance(s, box);
  const double viscous = film_speed(s, g, high + free);
  add_slide(s, box, true, all);
  if (free > 0.0 && !spans_floor(s, box)) {
    all.push_back(fall(g, free + high, gas_beside_liquid));
  } else if (free > 0.0 || !spans_floor(s, box)) {  // gas under a whole layer has no way past it
    const double speed = std::min(std::sqrt(2.0 * g * high), viscous), time = std::sqrt(high / g);
    all.push_back({speed / (std::sqrt(2.0) * time), std::sqrt(2.0) * time, speed, times_of_collapse * time,
                   late_liquid * speed});
  } else if (s.inclination != 0.0 && s.sides[left].kind != SideKind::periodic &&
             (s.sides[top].kind == SideKind::open || box.upper[1] < s.tank[1] * (1.0 - off))) {
    const double speed = std::min(std::sqrt(g * high), viscous), time = std::sqrt(high / g);
    all.push_back({0.0, 0.0, speed, times_of_collapse * time, late_liquid * speed});
  }
}

void add_bed(const Scene& s, std::vector<Motion>& all) {
  const Bed& bed = *s.bed;
  const double g = normal_gravity(s), high = extent(bed.box, 1), free = clearance(s, bed.box);
  const bool immersed = is_immersed(s, bed.box);
  add_slide(s, bed.box, false, all);
  if (free > 0.0 && !immersed) {
    all.push_back(fall(g, free + high, gas_beside_grains));
    return;
  }
  const bool sinks = !immersed || s.solid.density > s.liquid.density;
  const bool holds =
      std::tan(std::fabs(s.inclination) * std::numbers::pi / 180.0) <= s.solid.friction &&
      std::ranges::none_of(s.sides, [](const Side& side) { return side.kind == SideKind::outlet; });
  if (spans_floor(s, bed.box) && bed.slope == 90.0 && free == 0.0 && sinks && holds) {
    // Grains that do not touch yet fall until they do; in a liquid they settle.
    const double way = high * (1.0 - bed.solid_fraction / s.contact.solid_fraction_min);
    if (way > off * s.tank[1] && !immersed) all.push_back(fall(g, way, 1.0));
    return;
  }
  const double speed = std::sqrt(g * high);
  all.push_back({0.0, 0.0, speed, times_of_collapse * high / speed, late_bed * speed});
}

// What obstacles leave open of a section of the tank across `axis`, at its narrowest: a share.
double narrowest(const Scene& s, int axis) {
  double least = 1.0;
  const double area = s.tank[0] * s.tank[1] * s.tank[2] / s.tank[axis];
  for (const Box& at : s.obstacles) {
    double closed = 0.0;
    for (const Box& other : s.obstacles) {
      const double middle = 0.5 * (at.lower[axis] + at.upper[axis]);
      if (middle < other.lower[axis] || middle > other.upper[axis]) continue;
      double of_other = 1.0;
      for (int d = 0; d < 3; ++d)
        if (d != axis) of_other *= d < s.dimensions ? extent(other, d) : s.tank[d];
      closed += of_other;
    }
    least = std::min(least, 1.0 - closed / area);
  }
  return std::max(least, s.grid.spacing[axis == 1 ? 0 : 1] / s.tank[axis == 1 ? 0 : 1]);
}

double level_of(const Scene& s) {
  double level = 0.0;
  for (const Box& box : s.liquid_boxes) level = std::max(level, box.upper[1]);
  return level;
}

void add_side(const Scene& s, int index, std::vector<Motion>& all) {
  const Side& side = s.sides[index];
  const int axis = index / 2;
  const double g = normal_gravity(s), wall = std::hypot(side.velocity[0], side.velocity[1], side.velocity[2]);
  if (wall > 0.0) all.push_back(steady(share_of_wall * wall));
  if (side.kind == SideKind::inlet) {
    const int beside = axis == 1 ? left : bottom;
    const bool rough = s.sides[beside].fluid.kind == WallKind::no_slip ||
                       s.sides[beside + 1].fluid.kind == WallKind::no_slip;
    double speed =
        side.inflow.speed / narrowest(s, axis) * (rough ? between_rough_walls : between_slip_walls);
    if (s.bed && axis == 1 && spans_floor(s, s.bed->box)) speed /= 1.0 - s.bed->solid_fraction;
    double ground = level_of(s);
    if (s.bed && spans_floor(s, s.bed->box)) ground = std::max(ground, s.bed->box.upper[1]);
    const double drop = std::max(s.tank[1] - ground, 0.0);
    const bool grains = side.inflow.solid_fraction > 0.0;
    if (index != bottom && (grains || side.inflow.liquid_share > 0.0)) {
      const double fall = std::sqrt(2.0 * g * drop);
      speed = std::hypot(speed, grains ? fall : std::min(fall, film_speed(s, g, drop)));
    }
    all.push_back(steady(speed));
  } else if (side.kind == SideKind::outlet && !s.liquid_boxes.empty()) {
    const double head = std::max(level_of(s) - side.outflow.level, 0.0);
    all.push_back(steady(std::min(std::sqrt(2.0 * g * head), film_speed(s, g, head))));
  }
}

}  // namespace

double Motion::at(double time) const {
  if (time < grown) return acceleration * time;
  return time < lasts ? speed : late;
}

std::vector<Motion> fast_motions(const Scene& scene) {
  std::vector<Motion> all;
  for (int side = 0; side < 6; ++side) add_side(scene, side, all);
  if (scene.gravity == 0.0) return all;
  for (const Box& box : scene.liquid_boxes) add_liquid(scene, box, all);
  if (scene.bed) add_bed(scene, all);
  return all;
}

}  // namespace granvof
