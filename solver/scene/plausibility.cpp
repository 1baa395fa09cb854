#include "solver/scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "solver/closures/elastic_energy.hpp"
#include "solver/scene/side_names.hpp"
#include "solver/scene/time_scale.hpp"

namespace granvof {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double steepest = 1.5;  // tan of 56 degrees: no dry grains rest on a steeper slope [-]

using Number = std::optional<double>;  // none: the scene has no such thing, or 0 switches it off
struct Usual {
  double lower = 0.0, upper = infinity;
};
struct Row {
  std::string key;
  std::function<std::optional<Implausible>(const Scene&)> look;
};

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + unit;
}

std::string text_of(const Usual& usual, const std::string& unit) {
  std::string text = fmt::format("{:.3g} to {:.3g}", usual.lower, usual.upper);
  if (usual.upper == infinity) text = fmt::format("at least {:.3g}", usual.lower);
  if (usual.lower == 0.0) text = fmt::format("at most {:.3g}", usual.upper);
  return with_unit(text, unit);
}

// A value against a range, either of which the scene may decide.
template <class Value, class Range, class Reason>
Row row(const std::string& key, const std::string& unit, Value value, Range range, Reason reason) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            const Number x = value(scene);
            if (!x) return std::nullopt;
            Usual usual;
            if constexpr (std::is_same_v<Range, Usual>) {
              usual = range;
            } else {
              usual = range(scene);
            }
            if (*x >= usual.lower && *x <= usual.upper) return std::nullopt;
            std::string why;
            if constexpr (std::is_invocable_v<Reason, const Scene&>) {
              why = reason(scene);
            } else {
              why = reason;
            }
            return Implausible{key, with_unit(fmt::format("{:.9g}", *x), unit), text_of(usual, unit), why};
          }};
}

// A parameter of a choice that is not made: at its default nobody asked for it.
template <class Value, class Used>
Row idle(const std::string& key, Value value, Used used, const std::string& without) {
  return {key, [=](const Scene& scene) -> std::optional<Implausible> {
            if (used(scene) || value(scene.contact) == value(Contact{})) return std::nullopt;
            return Implausible{key, fmt::format("{}", value(scene.contact)), "its default",
                               "it has no effect without " + without};
          }};
}

// --- what the scene's parts give -----------------------------------------------------------------------

Number positive(double x) {
  return x > 0.0 ? Number(x) : std::nullopt;
}
Number if_bed(const Scene& s, double x) {
  return s.bed ? Number(x) : std::nullopt;
}
Number if_liquid(const Scene& s, double x) {
  return s.liquid_boxes.empty() ? std::nullopt : Number(x);
}
Number if_gate(const Scene& s, double x) {
  return s.gate ? Number(x) : std::nullopt;
}
double extent(const Box& box, int axis) {
  return box.upper[axis] - box.lower[axis];
}
double bed_height(const Scene& s) {
  return s.bed ? extent(s.bed->box, 1) : infinity;
}
double smallest_cell(const Scene& s) {
  return *std::min_element(s.grid.spacing.begin(), s.grid.spacing.begin() + s.dimensions);
}
double shortest_of_bed(const Scene& s) {
  double shortest = infinity;
  for (int axis = 0; axis < s.dimensions; ++axis) shortest = std::min(shortest, extent(s.bed->box, axis));
  return shortest;
}

// Energy that the contacts of the bed hold at solid fraction f, over that of its own height above its base
// [-].
double springs(const Scene& s, double f) {
  const closures::ElasticEnergy energy(s.contact);
  return energy(f, s.contact.solid_fraction_min) / (f * s.solid.density * s.gravity * 0.5 * bed_height(s));
}
bool may_spring(const Scene& s) {
  return s.bed && s.gravity > 0.0 && !s.model.shear_dilatancy &&
         s.bed->solid_fraction > s.contact.solid_fraction_min;
}
// From which share on a bed springs visibly: it lifts its own middle by so much of it.
constexpr double largest_spring = 0.05;
Usual fractions_that_rest(const Scene& s) {
  double rests = s.contact.solid_fraction_min, springs_up = s.contact.solid_fraction_max;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (rests + springs_up);
    (springs(s, middle) > largest_spring ? springs_up : rests) = middle;
  }
  return {0.0, rests};
}

// Stiffness that bears the bed's weight within half of the packings at which grains touch [Pa], by (13).
double bearing_stiffness(const Scene& s) {
  const double half = 0.5 * (s.contact.solid_fraction_max - s.contact.solid_fraction_min);
  return s.solid.density * s.gravity * bed_height(s) / std::pow(half, s.contact.exponent);
}

double off_the_bed(const Scene& s) {
  const Box& bed = s.bed->box;
  return std::min(std::fabs(s.gate->position - bed.lower[0]), std::fabs(s.gate->position - bed.upper[0]));
}

double wall_speed(const Side& side) {
  return std::hypot(side.velocity[0], side.velocity[1], side.velocity[2]);
}

// Share of time_scale that a step may take: s1 on 5 mm with steps up to 0.07 / 0.14 / 0.28 of it has its
// front 0.4 / 0.9 / 1.1 % farther than with 0.014.
constexpr double longest_step = 0.2;

// --- the table -------------------------------------------------------------------------------------------

constexpr Usual of_grains{1e-5, 0.1};  // their diameter [m]

std::vector<Row> tank_rows() {
  const auto largest = [](const Scene& s) -> Number {
    return *std::max_element(s.tank.begin(), s.tank.begin() + s.dimensions);
  };
  const auto smallest = [](const Scene& s) -> Number {
    return *std::min_element(s.tank.begin(), s.tank.begin() + s.dimensions);
  };
  return {
      row("tank.size", "m", largest, Usual{0.0, 50.0}, "a tank of the size of a building; millimetres?"),
      row("tank.size", "m", smallest, Usual{1e-4, infinity}, "a tank of the size of a grain; kilometres?"),
      row(
          "tank.depth", "m",
          [](const Scene& s) -> Number { return s.dimensions == 2 ? Number(s.tank[2]) : std::nullopt; },
          Usual{1e-4, 50.0}, "results are stated for this depth; millimetres?"),
      row(
          "tank.gravity", "m/s2", [](const Scene& s) { return positive(s.gravity); }, Usual{1.0, 30.0},
          "from the Moon's to Jupiter's; cm/s2, or km/s2?"),
  };
}

std::vector<Row> grid_rows() {
  return {
      row(
          "grid.dx", "m",
          [](const Scene& s) {  // a diameter that is no grain's says nothing about the cells
            const bool grains = s.solid.diameter >= of_grains.lower && s.solid.diameter <= of_grains.upper;
            return grains ? if_bed(s, smallest_cell(s)) : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{0.25 * s.solid.diameter, 1e3 * s.solid.diameter};
          },
          [](const Scene& s) {
            return fmt::format("a cell's average needs grains in it, solid.diameter = {} m",
                               s.solid.diameter);
          }),
  };
}

std::vector<Row> wall_rows() {
  std::vector<Row> rows;
  for (int side = 0; side < 6; ++side) {
    const std::string name = "walls." + std::string(case_file::side_names[side]);
    rows.push_back(row(
        name + ".solid_friction", "",
        [side](const Scene& s) -> Number { return s.sides[side].solid.friction; }, Usual{0.0, steepest},
        "the tangent of an angle; degrees?"));
    rows.push_back(row(
        name + ".velocity", "m/s", [side](const Scene& s) -> Number { return wall_speed(s.sides[side]); },
        Usual{0.0, 50.0}, "a wall that passes a laboratory in a blink; mm/s?"));
  }
  return rows;
}

std::vector<Row> fluid_rows() {
  const auto thickness = [](const Scene& s) {
    const bool like_water = s.liquid.density > 985.0 && s.liquid.density < 1040.0;
    return like_water ? if_liquid(s, s.liquid.viscosity) : std::nullopt;
  };
  return {
      row(
          "gas.density", "kg/m3", [](const Scene& s) -> Number { return s.gas.density; }, Usual{0.05, 200.0},
          "from hot hydrogen to air at 150 bar; air has 1.2; g/cm3?"),
      row(
          "gas.viscosity", "Pa s", [](const Scene& s) { return positive(s.gas.viscosity); },
          Usual{4e-6, 1e-4}, "air has 1.8e-5; mPa s (cP)?"),
      row(
          "liquid.density", "kg/m3", [](const Scene& s) { return if_liquid(s, s.liquid.density); },
          Usual{400.0, 14000.0}, "from propane to mercury; water has 1000; g/cm3?"),
      row(
          "liquid.viscosity", "Pa s",
          [](const Scene& s) { return s.liquid_boxes.empty() ? std::nullopt : positive(s.liquid.viscosity); },
          Usual{1e-4, 10.0},
          "from propane to honey; water has 1e-3; a kinematic viscosity (m2/s), or mPa s (cP)?"),
      row("liquid.viscosity", "Pa s", thickness, Usual{0.0, 0.3},
          "a liquid as heavy as water that flows like syrup; water has 1e-3; mPa s (cP)?"),
  };
}

std::vector<Row> solid_rows() {
  return {
      row(
          "solid.density", "kg/m3", [](const Scene& s) { return if_bed(s, s.solid.density); },
          Usual{10.0, 23000.0}, "from foamed polystyrene to osmium; glass has 2500; g/cm3?"),
      row(
          "solid.diameter", "m", [](const Scene& s) { return if_bed(s, s.solid.diameter); }, of_grains,
          "from silt to cobbles; finer grains stick; millimetres, or micrometres?"),
      row(
          "solid.diameter", "m", [](const Scene& s) { return if_bed(s, s.solid.diameter); },
          [](const Scene& s) {
            return Usual{0.0, shortest_of_bed(s) / 3.0};
          },
          "the bed is not three grains high and long"),
      row(
          "solid.diameter", "m", [](const Scene& s) { return if_bed(s, s.solid.diameter); },
          [](const Scene& s) {
            return Usual{0.0, smallest_cell(s)};
          },
          "larger than a cell (grid.dx), whose average needs grains in it"),
      row(
          "solid.restitution", "", [](const Scene& s) { return if_bed(s, s.solid.restitution); },
          Usual{0.05, 0.99}, "glass beads have 0.9; at 1 agitation never decays"),
      row(
          "solid.friction", "", [](const Scene& s) { return if_bed(s, s.solid.friction); },
          Usual{0.05, steepest},
          [](const Scene& s) {
            const double tangent = std::tan(s.solid.friction * std::numbers::pi / 180.0);
            return s.solid.friction > steepest && s.solid.friction < 60.0
                       ? fmt::format("the tangent of an angle: {:.3g} for {} degrees", tangent,
                                     s.solid.friction)
                       : std::string("the tangent of an angle; glass beads have 0.4");
          }),
  };
}

std::vector<Row> contact_rows() {
  const auto of_bed = [](auto member) {
    return [member](const Scene& s) { return if_bed(s, member(s.contact)); };
  };
  const auto model = [](auto member) { return [member](const Scene& s) { return member(s.model); }; };
  const auto shear = model([](const Model& m) { return m.shear_dilatancy; });
  const auto arrest = model([](const Model& m) { return m.thin_layer_arrest; });
  const auto inertial = model([](const Model& m) { return m.friction_law == FrictionLaw::inertial; });
  const auto either = [=](const Scene& s) { return arrest(s) || inertial(s); };
  const auto dilatancy = model([](const Model& m) { return m.dilatancy_pressure; });
  const auto friction = model([](const Model& m) { return m.contact_friction; });
  return {
      row(
          "contact.stiffness", "Pa", of_bed([](const Contact& c) { return c.stiffness; }),
          [](const Scene& s) {
            return Usual{bearing_stiffness(s), 1e12};
          },
          "from what bears the bed's weight without closing half of the gap between "
          "contact.solid_fraction_min and _max, to more than any grain's elasticity"),
      row("contact.exponent", "", of_bed([](const Contact& c) { return c.exponent; }), Usual{1.0, 3.0},
          "spheres in contact have 1.5 (Hertz)"),
      row("contact.solid_fraction_min", "", of_bed([](const Contact& c) { return c.solid_fraction_min; }),
          Usual{0.5, 0.65}, "random loose packing; spheres have 0.55 to 0.58"),
      row("contact.solid_fraction_max", "", of_bed([](const Contact& c) { return c.solid_fraction_max; }),
          Usual{0.55, 0.74}, "spheres reach 0.64 at random and 0.74 in a crystal"),
      row(
          "contact.regularisation", "s",
          [](const Scene& s) {
            return s.bed && s.gravity > 0.0 ? Number(s.contact.regularisation) : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{1e3 * fall_time(s), infinity};
          },
          "grains at rest creep within the time in which the scene changes"),
      row("contact.fast_friction", "", of_bed([](const Contact& c) { return c.fast_friction; }),
          Usual{0.05, steepest}, "the tangent of an angle; degrees?"),
      row("contact.inertial_number", "", of_bed([](const Contact& c) { return c.inertial_number; }),
          Usual{0.01, 2.0}, "glass beads have 0.28"),
      row("contact.stop_length", "", of_bed([](const Contact& c) { return c.stop_length; }), Usual{0.3, 20.0},
          "in grain diameters; glass beads have 1.65"),
      idle(
          "contact.critical_solid_fraction", [](const Contact& c) { return c.critical_solid_fraction; },
          shear, "model.shear_dilatancy"),
      idle(
          "contact.dilatancy_slope", [](const Contact& c) { return c.dilatancy_slope; }, shear,
          "model.shear_dilatancy"),
      idle(
          "contact.stop_length", [](const Contact& c) { return c.stop_length; }, arrest,
          "model.thin_layer_arrest"),
      idle(
          "contact.fast_friction", [](const Contact& c) { return c.fast_friction; }, either,
          "model.friction_law = \"inertial\" or model.thin_layer_arrest"),
      idle(
          "contact.inertial_number", [](const Contact& c) { return c.inertial_number; }, inertial,
          "model.friction_law = \"inertial\""),
      idle(
          "contact.dilatancy_factor", [](const Contact& c) { return c.dilatancy_factor; }, dilatancy,
          "model.dilatancy_pressure"),
      idle(
          "contact.dilatancy_exponent", [](const Contact& c) { return c.dilatancy_exponent; }, dilatancy,
          "model.dilatancy_pressure"),
      idle(
          "contact.dense_solid_fraction", [](const Contact& c) { return c.dense_solid_fraction; }, dilatancy,
          "model.dilatancy_pressure"),
      idle(
          "contact.regularisation", [](const Contact& c) { return c.regularisation; }, friction,
          "model.contact_friction"),
  };
}

std::vector<Row> bed_rows() {
  return {
      row(
          "bed.height", "m", [](const Scene& s) { return if_bed(s, bed_height(s)); },
          [](const Scene& s) {
            return Usual{2.0 * s.grid.spacing[1], infinity};
          },
          "the grid does not resolve the bed: two cells at least"),
      row(
          "bed.length", "m",
          [](const Scene& s) { return s.bed ? Number(extent(s.bed->box, 0)) : std::nullopt; },
          [](const Scene& s) {
            return Usual{std::min(2.0 * s.grid.spacing[0], s.tank[0]), infinity};
          },
          "the grid does not resolve the bed: two cells at least"),
      row(
          "bed.solid_fraction", "",
          [](const Scene& s) { return may_spring(s) ? Number(s.bed->solid_fraction) : std::nullopt; },
          fractions_that_rest,
          [](const Scene& s) {
            return fmt::format(
                "without model.shear_dilatancy a bed denser than contact.solid_fraction_min = {} springs: "
                "its "
                "contacts hold {:.3g} times the energy of its own height",
                s.contact.solid_fraction_min, springs(s, s.bed->solid_fraction));
          }),
      row(
          "bed.colour_size", "m",
          [](const Scene& s) {
            return s.bed && s.bed->colour != ColourPattern::uniform ? Number(s.bed->colour_size)
                                                                    : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{smallest_cell(s), infinity};
          },
          "bands finer than a cell are grey"),
      row(
          "gate.position", "m",
          [](const Scene& s) {
            const bool apart = s.gate && s.bed && off_the_bed(s) > s.grid.spacing[0];
            return apart ? Number(s.gate->position) : std::nullopt;
          },
          [](const Scene& s) {
            const double front = s.bed->box.upper[0];
            return Usual{front, front + s.grid.spacing[0]};
          },
          "a plate that does not touch the bed does not hold it"),
      row(
          "gate.speed", "m/s", [](const Scene& s) { return if_gate(s, s.gate->speed); },
          [](const Scene& s) {
            return Usual{0.1 * std::sqrt(s.gravity * bed_height(s)), 50.0};
          },
          "from slower than the collapse it sets free to that of a shot; mm/s?"),
  };
}

std::vector<Row> run_rows() {
  return {
      row(
          "time.end", "s",
          [](const Scene& s) { return s.gravity > 0.0 ? Number(s.times.end) : std::nullopt; },
          [](const Scene& s) {
            return Usual{1e-3 * fall_time(s), 1e7 * fall_time(s)};
          },
          "against the time in which the scene changes; time.unit, or milliseconds?"),
      row(
          "numerics.dt_max", "s", [](const Scene& s) -> Number { return s.numerics.dt_max; },
          [](const Scene& s) {
            return Usual{0.0, longest_step * time_scale(s)};
          },
          [](const Scene& s) {
            return fmt::format("the scene changes in {:.3g} s; results follow a longer step", time_scale(s));
          }),
      row(
          "numerics.dt_min", "s", [](const Scene& s) -> Number { return s.numerics.dt_min; },
          [](const Scene& s) {
            return Usual{0.0, 0.01 * s.numerics.dt_max};
          },
          "hardly a step may be refused before the run ends"),
      row(
          "numerics.volume_tolerance", "",
          [](const Scene& s) -> Number { return s.numerics.volume_tolerance; }, Usual{1e-12, 1e-3},
          "volume errors add up over the steps; rounding leaves 1e-14"),
      row(
          "numerics.linear_tolerance", "",
          [](const Scene& s) -> Number { return s.numerics.linear_tolerance; }, Usual{1e-10, 0.3},
          "solves that hardly reduce the residual, or to rounding, cost steps"),
  };
}

std::vector<Row> all_rows() {
  std::vector<Row> all;
  for (const auto& part :
       {tank_rows, grid_rows, wall_rows, fluid_rows, solid_rows, contact_rows, bed_rows, run_rows}) {
    for (Row& r : part()) all.push_back(std::move(r));
  }
  return all;
}

}  // namespace

std::vector<Implausible> plausibility(const Scene& scene) {
  std::vector<Implausible> found;
  for (const Row& r : all_rows()) {
    const bool named = std::ranges::any_of(found, [&](const Implausible& i) { return i.key == r.key; });
    if (named) continue;
    if (auto finding = r.look(scene)) found.push_back(std::move(*finding));
  }
  return found;
}

std::string text_of(const Implausible& finding) {
  return fmt::format("{} = {}: usual is {}: {}", finding.key, finding.given, finding.usual, finding.reason);
}

}  // namespace granvof
