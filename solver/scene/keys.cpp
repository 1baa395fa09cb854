#include "solver/scene/keys.hpp"

#include <algorithm>
#include <iterator>

#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/scene/key_types.hpp"
#include "solver/scene/keys_of_model.hpp"
#include "solver/scene/keys_of_sides.hpp"
#include "solver/scene/presets.hpp"
#include "solver/scene/words_of_list.hpp"

namespace granvof::case_file {
namespace {

// The member of a Draft that a key fills. A function cannot name a member of a member; this keeps a row on a
// line.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define MEMBER(path)         \
  [](auto& draft) -> auto& { \
    return draft.path;       \
  }
// NOLINTEND(bugprone-macro-parentheses)

std::vector<Key> scene_keys() {
  return {
      required(key("scene.name", "", any, MEMBER(scene.name), "Name of the case; equals the file's stem.")),
      otherwise(key("scene.title", "", any, MEMBER(scene.title), "One line for plots and reports."),
                "scene.name"),
      scoped(key(parts::grid, "scene.dimensions", "-", Bounds{.lower = 2, .upper = 3},
                 MEMBER(scene.dimensions), "2 or 3."),
             Scope::setup),
      required(
          key("tank.size", "m", positive, MEMBER(tank_size), "Inner size [x, y] in 2D, [x, y, z] in 3D.")),
      otherwise(
          key("tank.depth", "m", positive, MEMBER(depth), "2D only: depth that results are stated for."),
          "1"),
      key(parts::momentum, "tank.gravity", "m/s2", not_negative, MEMBER(scene.gravity),
          "Acts against y in a level tank."),
      came_later(key(parts::momentum, "tank.inclination", "degrees",
                     Bounds{.lower = -90.0, .upper = 90.0, .lower_open = true, .upper_open = true},
                     MEMBER(scene.inclination),
                     "Of the floor, down towards +x: g = gravity (sin, -cos). Levels and beds stay along x."),
                 "0"),
      required(key("grid.dx", "m", positive, MEMBER(dx), "Cell size in x; divides the tank's size.")),
      otherwise(key("grid.dy", "m", positive, MEMBER(dy), "Cell size in y."), "grid.dx"),
      otherwise(key("grid.dz", "m", positive, MEMBER(dz), "3D only: cell size in z."), "grid.dx"),
  };
}

std::vector<Key> material_keys() {
  return {
      required(key("gas.density", "kg/m3", positive, MEMBER(scene.gas.density), "rho_g.")),
      required(key(parts::fluid_viscosity, "gas.viscosity", "Pa s", not_negative, MEMBER(scene.gas.viscosity),
                   "mu_g.")),
      required(key("liquid.density", "kg/m3", positive, MEMBER(scene.liquid.density), "rho_l.")),
      required(key(parts::fluid_viscosity, "liquid.viscosity", "Pa s", not_negative,
                   MEMBER(scene.liquid.viscosity), "mu_l.")),
      key(parts::start, "liquid.level", "m", positive, MEMBER(level),
          "Liquid fills the tank up to here, the bed's pores included."),
      key(parts::start, "liquid.box.origin", "m", not_negative, MEMBER(box_origin),
          "Lower corner of a box of liquid."),
      key(parts::start, "liquid.box.size", "m", positive, MEMBER(box_size), "Size of that box."),
      required(key("solid.density", "kg/m3", positive, MEMBER(scene.solid.density), "rho_s.")),
      required(key("solid.diameter", "m", positive, MEMBER(scene.solid.diameter), "d_s.")),
      key(parts::kinetic_stress, "solid.restitution", "-", share, MEMBER(scene.solid.restitution),
          "e0 of eq (18)."),
      required(key(parts::friction, "solid.friction", "-", not_negative, MEMBER(scene.solid.friction),
                   "eta_s = tan(theta_s).")),
  };
}

std::vector<Key> bed_keys() {
  const Words<BedPlace> places{
      {"floor", BedPlace::floor}, {"on-water", BedPlace::on_water}, {"floating", BedPlace::floating}};
  const Words<ColourPattern> patterns{{"uniform", ColourPattern::uniform},
                                      {"layers", ColourPattern::layers},
                                      {"columns", ColourPattern::columns},
                                      {"checks", ColourPattern::checks}};
  const Bounds angle{.lower = 0.0, .upper = 90.0, .lower_open = true};
  return {
      key("bed.x", "m", not_negative, MEMBER(bed.x), "Where the bed begins."),
      required(key("bed.length", "m", positive, MEMBER(bed.length), "l0, along x.")),
      required(key("bed.height", "m", positive, MEMBER(bed.height), "h0.")),
      required(key("bed.solid_fraction", "-", part, MEMBER(bed.solid_fraction),
                   "Initial packing; at most contact.solid_fraction_max.")),
      otherwise(key("bed.solid_volume", "m3", positive, MEMBER(bed.solid_volume),
                    "Of all grains, in 2D for tank.depth: fills the box at solid_fraction up to a lower top; "
                    "h0 stays height."),
                "what the box holds"),
      number_or_word(
          "bed.y", "m", not_negative, places, MEMBER(bed.y),
          "Bottom of the bed: on the floor, at the liquid's level, or so deep that the immersed share is "
          "rho_s/rho_l."),
      key("bed.slope", "degrees", angle, MEMBER(bed.slope),
          "Of the front face: 90 is a box, less a heap that meets its base at x + length."),
      otherwise(key("bed.z", "m", not_negative, MEMBER(bed.z), "3D only: where the bed begins in z."), "0"),
      otherwise(key("bed.width", "m", positive, MEMBER(bed.width), "3D only: along z."), "the tank's"),
      scoped(choice("bed.colour", patterns, MEMBER(bed.colour),
                    "Bands of colour 1 and 0 in turn at the start, to show mixing; no effect on the flow."),
             Scope::run),
      scoped(key("bed.colour_size", "m", positive, MEMBER(bed.colour_size),
                 "Height of a layer, width of a column; required with bands."),
             Scope::run),
      otherwise(
          key("gate.position", "m", positive, MEMBER(gate_position), "x of the plate that holds the bed."),
          "the bed's front"),
      required(key("gate.speed", "m/s", positive, MEMBER(gate_speed), "Upwards, from t = 0.")),
  };
}

std::vector<Key> time_keys() {
  const std::string unit(unit_of_times);
  return {
      required(key("time.end", unit, positive, MEMBER(times.end), "Length of the run.")),
      choice("time.unit", Words<TimeUnit>{{"s", TimeUnit::second}, {"column", TimeUnit::column}},
             MEMBER(times.unit),
             "Unit of time.end and of [output]'s times: seconds, or sqrt(h0/g) of the bed."),
      scoped(key(parts::gate, "time.hold", "s", not_negative, MEMBER(times.hold),
                 "Held behind the closed gate before t = 0."),
             Scope::setup),
      otherwise(key("output.series_interval", unit, positive, MEMBER(times.series_interval),
                    "Between rows of series.csv."),
                "time.end / 200"),
      otherwise(
          key("output.field_times", unit, not_negative, MEMBER(times.field_times),
              "When fields are written, ascending; the end is added. An end that an override or a derived "
              "case brings forward drops the later ones."),
          "0 and the end"),
      key("output.field_interval", unit, positive, MEMBER(times.field_interval), "Instead of field_times."),
      key("output.checkpoint_interval", "wall-clock s", not_negative, MEMBER(times.checkpoint_interval),
          "Time between checkpoints; 0: at the end and on failure only."),
  };
}

std::vector<Key> numerics_keys() {
  const Words<BedSurface> surfaces{{"whole-cells", BedSurface::whole_cells},
                                   {"part-cells", BedSurface::part_cells}};
  const Words<Convection> convections{{"advective", Convection::advective},
                                      {"mass-consistent", Convection::mass_consistent}};
  const Words<InterfaceScheme> schemes{{"cicsam", InterfaceScheme::cicsam},
                                       {"plic", InterfaceScheme::plic},
                                       {"upwind", InterfaceScheme::upwind}};
  const Words<ContactPressure> contact_pressures{{"implicit", ContactPressure::implicit},
                                                 {"explicit", ContactPressure::explicit_}};
  return {
      key(parts::time_step, "numerics.cfl", "-", Bounds{.lower = 0.0, .upper = 0.9, .lower_open = true},
          MEMBER(scene.numerics.cfl), "Convective Courant number of a step."),
      otherwise(key(parts::time_step, "numerics.dt_max", "s", positive, MEMBER(scene.numerics.dt_max),
                    "Longest step."),
                "0.07 sqrt(h/g), h the height of the bed, else of the liquid, else of the tank"),
      otherwise(key(parts::time_step, "numerics.dt_min", "s", positive, MEMBER(scene.numerics.dt_min),
                    "A refused step that would be shorter ends the run; at most dt_max."),
                "2e-7 dt_max"),
      choice(
          parts::momentum, "numerics.solid_flux", words_of<closures::SlopeLimiters>(),
          MEMBER(scene.numerics.transport_scheme),
          "Flux of f_s and convection of both momenta: " + sources_of<closures::SlopeLimiters>() +
              "; the latter two of second order, bounded; that of a gas over a liquid stays of first order."),
      choice(parts::momentum, "numerics.solid_convection", convections,
             MEMBER(scene.numerics.solid_convection),
             "Convection of the grains' momentum: a face takes it up at its own speed, or with the "
             "mass that brings it."),
      choice(parts::momentum, "numerics.fluid_convection", convections,
             MEMBER(scene.numerics.fluid_convection), "The same of liquid and gas."),
      // Which grains bear load is physics, whatever table it stands in.
      scoped(
          came_later(
              choice(parts::bed_surface, "numerics.bed_surface", surfaces, MEMBER(scene.numerics.bed_surface),
                     "Contact needs f_s,min in the whole cell (the paper), or grains that fill a "
                     "part of a cell at the bed's surface bear their own weight, and friction by it."),
              R"("whole-cells")"),
          Scope::model),
      choice(parts::interface, "numerics.interface_scheme", schemes, MEMBER(scene.numerics.interface_scheme),
             "Flux of alpha in (24): compressive (the paper), geometric with split sweeps, or first order."),
      choice(
          parts::solid_pressure, "numerics.contact_pressure", contact_pressures,
          MEMBER(scene.numerics.contact_pressure),
          "P_s of the new solid fraction; or of the old one, with steps below the elastic waves' limit: for "
          "comparison."),
      key(parts::pressure, "numerics.volume_tolerance", "-", part, MEMBER(scene.numerics.volume_tolerance),
          "Largest volume error of a cell in one step, as a share of the cell."),
      key(parts::pressure, "numerics.linear_tolerance", "-", part, MEMBER(scene.numerics.linear_tolerance),
          "Residual reduction of one linear solve inside Newton."),
      key(parts::pressure, "numerics.newton_max", "-", Bounds{.lower = 4, .upper = 1000},
          MEMBER(scene.numerics.newton_max), "Most Newton iterations of a step."),
  };
}

std::vector<Key> reference_keys() {
  const Words<ReferenceFloor> floors{{"rough", ReferenceFloor::rough}, {"smooth", ReferenceFloor::smooth}};
  const Words<ReferenceRelease> releases{{"gate", ReferenceRelease::gate},
                                         {"instant", ReferenceRelease::instant}};
  const Words<ReferenceConvection> convections{{"upwind", ReferenceConvection::upwind},
                                               {"van-leer", ReferenceConvection::van_leer}};
  const Bounds poisson{.lower = -1.0, .upper = 0.5, .lower_open = true, .upper_open = true};
  return {
      required(
          key("reference.cell", "m", positive, MEMBER(reference.settings.cell), "Edge of a fluid cell.")),
      key("reference.fluid_dt", "s", positive, MEMBER(reference.settings.fluid_dt), "Fluid step."),
      key("reference.dt", "s", positive, MEMBER(reference.settings.dt),
          "DEM step; with coarse_graining that many times longer; at most fluid_dt."),
      came_later(key("reference.coarse_graining", "-", Bounds{.lower = 1.0, .upper = 10.0},
                     MEMBER(reference.settings.coarse_graining),
                     "Bead's over grain's diameter: a bead stands for its cube of grains."),
                 "1"),
      came_later(choice("reference.convection", convections, MEMBER(reference.settings.convection),
                        "Of the fluid's momentum: of first order, or of second, limited."),
                 R"("upwind")"),
      otherwise(key("reference.slice_depth", "m", positive, MEMBER(reference.slice_depth),
                    "Depth of the slice; required in 2D, 2D only."),
                "the tank's (3D)"),
      key("reference.seeds", "-", not_negative, MEMBER(reference.settings.seeds),
          "One run per seed; their spread is the reference's uncertainty."),
      choice("reference.floor", floors, MEMBER(reference.settings.floor),
             "Covered with frozen beads, or a plane."),
      otherwise(choice("reference.release", releases, MEMBER(reference.release),
                       "At t = 0 the gate rises at gate.speed, or is gone."),
                R"("gate" with a [gate], else "instant")"),
      otherwise(key("reference.hold", "s", not_negative, MEMBER(reference.hold),
                    "Behind the closed gate under the final contact law, before t = 0."),
                toml_text(ReferenceSettings{}.hold) + " with a [gate], else 0"),
      key("reference.young", "Pa", positive, MEMBER(reference.settings.young),
          "Young's modulus of the beads."),
      key("reference.poisson", "-", poisson, MEMBER(reference.settings.poisson),
          "Poisson's ratio of the beads."),
      otherwise(
          key("reference.bead_friction", "-", not_negative, MEMBER(reference.bead_friction), "Bead on bead."),
          "solid.friction"),
      key("reference.bead_rolling_friction", "-", not_negative,
          MEMBER(reference.settings.bead_rolling_friction), "Bead on bead."),
      otherwise(
          key("reference.bead_restitution", "-", share, MEMBER(reference.bead_restitution), "Bead on bead."),
          "solid.restitution"),
      otherwise(
          key("reference.wall_friction", "-", not_negative, MEMBER(reference.wall_friction), "Bead on wall."),
          "reference.bead_friction"),
      otherwise(key("reference.gate_friction", "-", not_negative, MEMBER(reference.gate_friction),
                    "Bead on the gate's plate, closed and while it rises; needs [gate]."),
                "reference.wall_friction"),
      otherwise(key("reference.packing", "-", part, MEMBER(reference.packing), "Solid fraction to prepare."),
                "bed.solid_fraction"),
      key("reference.preparation_friction", "-", not_negative,
          MEMBER(reference.settings.preparation_friction),
          "Bead on bead while the bed settles: sets the packing."),
      key("reference.preparation_rolling_friction", "-", not_negative,
          MEMBER(reference.settings.preparation_rolling_friction), "Likewise."),
  };
}

#undef MEMBER

std::vector<Key> all_keys() {
  std::vector<Key> all;
  const auto add = [&](std::vector<Key> list) {
    for (Key& k : list) {
      if (k.scope == Scope::unset) k.scope = find_table(k.table())->scope;
      if (k.part == nullptr) k.part = find_table(k.table())->part;
      if (set_by_a_preset(k.name)) k.otherwise = "model.preset's";
      all.push_back(std::move(k));
    }
  };
  add(scene_keys());
  for (int side = 0; side <= side_all; ++side) add(side_keys(side));
  add(material_keys());
  add(contact_keys());
  add(bed_keys());
  add(obstacle_keys());
  add(time_keys());
  add(model_keys());
  add(numerics_keys());
  add(reference_keys());
  // What is printed under one heading must stand together.
  std::stable_sort(all.begin(), all.end(),
                   [](const Key& a, const Key& b) { return find_table(a.table()) < find_table(b.table()); });
  return all;
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> list{
      {"scene", Scope::label, &parts::label, false, "What the case is called."},
      {"tank", Scope::setup, &parts::grid, false, "The box that holds everything."},
      {"grid", Scope::run, &parts::grid, false, "Uniform cells."},
      {"walls", Scope::setup, &parts::walls, false,
       "What each side of the tank does, as one word or as a table of its own."},
      {"gas", Scope::setup, &parts::materials, false, "The gas."},
      {"liquid", Scope::setup, &parts::materials, true, "The liquid; a case may have none."},
      {"solid", Scope::setup, &parts::materials, true, "The grains; a case may have none."},
      {"contact", Scope::model, nullptr, false, "Enduring contact, (13)-(17); the defaults are the paper's."},
      {"bed", Scope::setup, &parts::start, true, "Where the grains are at the start; needs [solid]."},
      {"gate", Scope::setup, &parts::gate, true,
       "A vertical plate that holds the bed, and along which both phases slip; needs [bed]."},
      {"obstacle", Scope::setup, &parts::obstacles, true,
       "Boxes that no phase enters, [[obstacle]] as often as there are; or one [obstacle] with lists.", true},
      {"time", Scope::run, &parts::time_step, false, "Length of the run."},
      {"model", Scope::model, nullptr, false, "What is modelled; each switch removes one physical part."},
      {"numerics", Scope::run, nullptr, false, "How it is computed."},
      {"output", Scope::run, &parts::output, false, "What is written, and when."},
      {"reference", Scope::reference, &parts::reference, true,
       "The DEM-VOF run of the same scene; needs [bed]."},
  };
  return list;
}

const Table* find_table(std::string_view name) {
  const auto found = std::ranges::find(tables(), name, &Table::name);
  return found == tables().end() ? nullptr : &*found;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> list = all_keys();
  return list;
}

const Key* find_key(std::string_view name) {
  const auto found = std::ranges::find(keys(), name, &Key::name);
  return found == keys().end() ? nullptr : &*found;
}

}  // namespace granvof::case_file
