#include "solver/plausibility/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/scales.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof {
namespace plausible {
namespace {

// Of the thinnest box of liquid, along the axis on which it is thinnest [m].
Number thinnest_liquid(const Scene& s) {
  Number thinnest;
  for (const Box& box : s.liquid_boxes)
    for (int axis = 0; axis < s.dimensions; ++axis)
      if (!thinnest || extent(box, axis) < *thinnest) thinnest = extent(box, axis);
  return thinnest;
}

// Least time between two instants whose fields are written, or from the start to the first [s].
Number closest_fields(const Scene& s) {
  Number closest;
  double before = 0.0;
  for (const double time : s.times.field_times) {
    if (time > before && (!closest || time - before < *closest)) closest = time - before;
    before = time;
  }
  return closest;
}

double wall_speed(const Side& side) {
  return std::hypot(side.velocity[0], side.velocity[1], side.velocity[2]);
}

// [s]: that of the scene; or, where that takes longer, the time in which a grain settles or rises by a cell
// in the liquid (Stokes), which is how fast a suspension changes.
double time_of_change(const Scene& s) {
  const double time = scales_of(s).time();
  if (!s.bed || s.liquid_boxes.empty()) return time;
  const double excess = std::fabs(s.solid.density - s.liquid.density);
  const double d = s.solid.diameter;
  const double stokes = excess * s.gravity * d * d / (18.0 * s.liquid.viscosity);
  return std::max(time, s.grid.spacing[1] / stokes);
}
// Share of time_of_change() that a step may take: s1 on 5 mm with steps up to 0.07 / 0.14 / 0.28 of it has
// its front 0.4 / 0.9 / 1.1 % farther than with 0.014.
constexpr double longest_step = 0.2;

// --- the table -------------------------------------------------------------------------------------------

constexpr double thinnest_of_cell = 0.1;  // of liquid, in cells: less shows in no profile
constexpr double least_share = 1e-4;      // of what comes in: less is not there
constexpr double shortest_checkpoint = 0.1,
                 longest_checkpoint = 1e7;  // between two, of a clock on the wall [s]

// Of an outlet: ten tanks full of its heaviest fluid; without gravity what sends that fluid through the tank
// a thousand times in a run [Pa].
double largest_pressure(const Scene& s) {
  const double rho = std::max(s.gas.density, s.liquid.density);
  const double size = *std::max_element(s.tank.begin(), s.tank.begin() + s.dimensions);
  const double speed = 1e3 * size / s.times.end;
  return s.gravity > 0.0 ? 10.0 * rho * s.gravity * size : rho * speed * speed;
}

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
      row(
          "tank.inclination", "degrees", [](const Scene& s) { return positive(std::fabs(s.inclination)); },
          Usual{0.0, 60.0}, "steeper than any chute; from the vertical?"),
  };
}

// Edges of cells against their width. A heap of 12 degrees came to rest at 7.8 on cells of 10 mm and as well
// on ones a quarter or an eighth as wide: what is long decides. Cells ten times as wide as high did no worse
// than square ones; eighty times, and solves of friction do not end.
constexpr Usual of_aspect{0.1, 4.0};

std::vector<Row> grid_rows() {
  std::vector<Row> rows;
  for (int axis = 0; axis < 3; ++axis) {
    rows.push_back(row(
        std::string("grid.d") + "xyz"[axis], "m",
        [axis](const Scene& s) -> Number {
          const double h = s.grid.spacing[axis];
          const bool as_in_x = axis > 0 && std::fabs(h - s.grid.spacing[0]) < off_a_face * h;
          return axis >= s.dimensions || as_in_x || !is_grain(s) ? std::nullopt : if_bed(s, h);
        },
        [](const Scene& s) {
          return Usual{0.25 * s.solid.diameter, 1e3 * s.solid.diameter};
        },
        [](const Scene& s) {
          return fmt::format("a cell's average needs grains in it, solid.diameter = {} m", s.solid.diameter);
        }));
  }
  for (int axis = 1; axis < 3; ++axis)
    rows.push_back(row(
        std::string("grid.d") + "xyz"[axis], "m",
        [axis](const Scene& s) -> Number {
          const auto& n = s.grid.cells;
          return axis < s.dimensions && n[0] > 1 && n[axis] > 1 ? Number(s.grid.spacing[axis]) : std::nullopt;
        },
        [](const Scene& s) {
          const double rounding = 1e-9;
          const double dx = s.grid.spacing[0];
          return Usual{(1.0 - rounding) * of_aspect.lower * dx, (1.0 + rounding) * of_aspect.upper * dx};
        },
        [axis](const Scene& s) {
          return fmt::format(
              "cells {:.3g} times as long one way as the other: results follow the long edge, steps the "
              "short one",
              std::max(s.grid.spacing[axis] / s.grid.spacing[0], s.grid.spacing[0] / s.grid.spacing[axis]));
        }));
  return rows;
}

std::vector<Row> wall_rows() {
  std::vector<Row> rows;
  for (int side = 0; side < 6; ++side) {
    const std::string name = "walls." + std::string(case_file::side_names[side]);
    rows.push_back(row(
        name + ".solid_friction", "",
        [side](const Scene& s) -> Number { return s.sides[side].solid.friction; }, of_friction,
        "the tangent of an angle; degrees?"));
    rows.push_back(row(
        name + ".bumpiness", "degrees",
        [side](const Scene& s) { return positive(s.sides[side].solid.bumpiness); }, Usual{1.0, 90.0},
        "bumps that no grain feels; a tangent, or radians?"));
    rows.push_back(row(
        name + ".bump_restitution", "",
        [side](const Scene& s) -> Number {
          const PhaseWall& wall = s.sides[side].solid;
          return wall.kind == WallKind::bumpy && wall.restitution != s.solid.restitution
                     ? Number(wall.restitution)
                     : std::nullopt;
        },
        of_restitution, "glass beads have 0.9"));
    rows.push_back(row(
        name + ".velocity", "m/s", [side](const Scene& s) -> Number { return wall_speed(s.sides[side]); },
        Usual{0.0, 50.0}, "a wall that passes a laboratory in a blink; mm/s?"));
    rows.push_back(row(
        name + ".inflow", "m/s", [side](const Scene& s) { return positive(s.sides[side].inflow.speed); },
        Usual{1e-6, 50.0}, "a jet that crosses a laboratory in a blink; mm/s?"));
    rows.push_back(row(
        name + ".inflow_solid_fraction", "",
        [side](const Scene& s) { return positive(s.sides[side].inflow.solid_fraction); },
        Usual{least_share, 1.0}, "next to nothing comes in; per cent, or a concentration in kg/m3?"));
    rows.push_back(row(
        name + ".inflow_liquid_share", "",
        [side](const Scene& s) { return positive(s.sides[side].inflow.liquid_share); },
        Usual{least_share, 1.0}, "next to nothing of what comes in; 0 is gas alone, 1 liquid"));
    rows.push_back(row(
        name + ".outflow_pressure", "Pa",
        [side](const Scene& s) { return positive(std::fabs(s.sides[side].outflow.pressure)); },
        [](const Scene& s) {
          return Usual{0.0, largest_pressure(s)};
        },
        "against the weight of what fills the tank, or what sets it in motion; it counts from that of the "
        "air"));
    rows.push_back(row(
        name + ".outflow_level", "m",
        [side](const Scene& s) { return positive(s.sides[side].outflow.level); },
        [](const Scene& s) {
          return Usual{thinnest_of_cell * s.grid.spacing[1], infinity};
        },
        "the grid does not resolve liquid that is so thin"));
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
      missing(
          "liquid.level", [](const Scene& s) { return s.liquid_boxes.empty() && s.liquid != s.gas; },
          "a level or a liquid.box", "the case has a [liquid], but none of it in the tank"),
      row(
          "liquid", "m", thinnest_liquid,
          [](const Scene& s) {
            return Usual{thinnest_of_cell * smallest_cell(s), infinity};
          },
          "the grid does not resolve liquid that is so thin (liquid.level, liquid.box.size)"),
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
          of_restitution, "glass beads have 0.9; at 1 agitation never decays"),
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

std::vector<Row> run_rows() {
  return {
      row(
          "time.end", "s", [](const Scene& s) -> Number { return s.times.end; },
          [](const Scene& s) {
            return Usual{1e-3 * scales_of(s).time(), 1e7 * scales_of(s).time()};
          },
          "against the time in which the scene changes; time.unit, or milliseconds?"),
      row(
          "time.hold", "s", [](const Scene& s) -> Number { return positive(s.times.hold); },
          [](const Scene& s) {
            return Usual{shortest_step * scales_of(s).time(), longest_hold * scales_of(s).time()};
          },
          [](const Scene& s) {
            return fmt::format(
                "a bed that the gate holds rests in some times of {:.3g} s; the run begins after it",
                scales_of(s).time());
          }),
      flow_step_row("numerics.dt_max", [](const Scene& s) -> Number { return s.numerics.dt_max; }),
      row(
          "numerics.cfl", "", [](const Scene& s) -> Number { return s.numerics.cfl; }, Usual{1e-3, infinity},
          "a step in which nothing moves by a thousandth of a cell only costs"),
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
      row(
          "output.field_times", "s", closest_fields,
          [](const Scene& s) {
            return Usual{shortest_step * scales_of(s).time(), infinity};
          },
          "between two of them: the run has to meet both, by a step that is as short"),
      row(
          "output.checkpoint_interval", "s",
          [](const Scene& s) { return positive(s.times.checkpoint_interval); },
          Usual{shortest_checkpoint, longest_checkpoint},
          "of a clock on the wall: one after every step costs more than the step, one in a year is none; 0 "
          "for "
          "the end alone"),
  };
}

std::vector<Row> all_rows() {
  std::vector<Row> all;
  for (const auto& part : {tank_rows, grid_rows, wall_rows, fluid_rows, solid_rows, contact_rows, bed_rows,
                           run_rows, reference_rows}) {
    for (Row& r : part()) all.push_back(std::move(r));
  }
  return all;
}

// Of a key, or of the first of a table, among all keys.
std::ptrdiff_t place_of(const std::string& key) {
  const auto& all = case_file::keys();
  const auto found =
      std::ranges::find_if(all, [&](const case_file::Key& k) { return k.name.starts_with(key); });
  return found - all.begin();
}

}  // namespace

Row flow_step_row(const std::string& key, const std::function<Number(const Scene&)>& step) {
  return row(
      key, "s", step,
      [](const Scene& s) {
        return Usual{shortest_step * scales_of(s).time(), longest_step * time_of_change(s)};
      },
      [](const Scene& s) {
        return fmt::format(
            "the scene changes in {:.3g} s; results follow a longer step, a far shorter one only costs",
            time_of_change(s));
      });
}

}  // namespace plausible

std::vector<Implausible> plausibility(const Scene& scene) {
  std::vector<Implausible> found;
  const auto add = [&](std::optional<Implausible> finding) {
    const auto same = [&](const Implausible& other) { return other.key == finding->key; };
    if (finding && std::ranges::none_of(found, same)) found.push_back(std::move(*finding));
  };
  for (Implausible& idle : plausible::idle_keys(scene)) add(std::move(idle));
  for (const plausible::Row& r : plausible::all_rows()) add(r.look(scene));
  std::ranges::stable_sort(found, {}, [](const Implausible& i) { return plausible::place_of(i.key); });
  return found;
}

std::string text_of(const Implausible& finding) {
  return fmt::format("{} = {}: usual is {}: {}", finding.key, finding.given, finding.usual, finding.reason);
}

}  // namespace granvof
