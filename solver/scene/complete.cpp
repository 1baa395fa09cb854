#include "solver/scene/complete.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/regular_times.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof::case_file {
namespace {

constexpr double most_cells = 1e9;  // of a grid
constexpr double most_rows = 1e6;   // of series.csv
constexpr double most_field_times = 1e4;
constexpr double roundoff = 1e-9;  // relative: lengths that differ by less are the same

const std::array<std::string, 3> axis_names{"x", "y", "z"};

// One pass over the draft, part by part; each part may use what those before it have set.
class Completion {
 public:
  Completion(Draft& draft, const CaseText& text) : d_(draft), text_(text), s_(draft.scene) {}

  Scene run() {
    if (s_.title.empty()) s_.title = s_.name;
    tank();
    grid();
    walls();
    materials();
    bed();
    gate();
    times();
    fields();
    numerics();
    if (has("reference")) reference();
    return s_;
  }

 private:
  bool has(const std::string& table) const { return d_.tables.contains(table); }
  bool given(const std::string& key) const { return text_.entries.contains(key); }
  bool flat() const { return s_.dimensions == 2; }
  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const {
    case_file::refuse(text_, d_, key, allowed);
  }
  void only_in_3d(const std::string& key) const {
    if (flat() && given(key)) refuse(key, "no such key in 2D (scene.dimensions = 2)");
  }
  std::string where_of(const std::string& table) const {
    const auto found = text_.tables.find(table);
    return found == text_.tables.end() ? text_.file : found->second;
  }
  void needs(const std::string& table, const std::string& other) const {
    if (has(table) && !has(other)) {
      throw CaseError(fmt::format("{}: {}: got [{}] without [{}], allowed: both or neither", where_of(table),
                                  table, table, other));
    }
  }
  void components(const std::string& key, const std::vector<double>& list) const {
    if (static_cast<int>(list.size()) != s_.dimensions) {
      refuse(key, fmt::format("{} numbers (scene.dimensions = {})", s_.dimensions, s_.dimensions));
    }
  }
  // Whether lower..upper reaches beyond the tank, rounding apart.
  bool outside(double lower, double upper, int axis) const {
    return lower < -roundoff * s_.tank[axis] || upper > s_.tank[axis] * (1.0 + roundoff);
  }

  void tank() {
    components("tank.size", d_.tank_size);
    if (!flat() && given("tank.depth")) refuse("tank.depth", "no such key in 3D: tank.size has the depth");
    if (flat()) d_.depth = d_.depth.value_or(1.0);
    s_.tank = {d_.tank_size[0], d_.tank_size[1], flat() ? *d_.depth : d_.tank_size[2]};
  }

  void grid() {
    only_in_3d("grid.dz");
    d_.dy = d_.dy.value_or(d_.dx);
    if (!flat()) d_.dz = d_.dz.value_or(d_.dx);
    const std::array<double, 3> wanted{d_.dx, *d_.dy, d_.dz.value_or(s_.tank[2])};
    double total = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      std::string key = "grid.d" + axis_names[axis];
      if (!given(key)) key = "grid.dx";
      const double cells = s_.tank[axis] / wanted[axis];
      const double whole = std::round(cells);
      total *= std::max(1.0, cells);
      if (total > most_cells) refuse(key, fmt::format("a spacing that gives at most {} cells", most_cells));
      if (whole < 1.0 || std::abs(cells - whole) > 1e-6) {
        const double fewer = std::max(1.0, std::floor(cells));
        refuse(key,
               fmt::format(
                   "a spacing that divides the tank's {} = {} m into whole cells, the nearest {:.9g} ({} "
                   "cells) and {:.9g} ({} cells)",
                   axis_names[axis], s_.tank[axis], s_.tank[axis] / (fewer + 1.0), fewer + 1.0,
                   s_.tank[axis] / fewer, fewer));
      }
      s_.grid.cells[axis] = static_cast<int>(whole);
      s_.grid.spacing[axis] = s_.tank[axis] / whole;
    }
  }

  void walls() {
    for (int side = 0; side <= side_all; ++side) check_side(side);
    for (int side = 0; side < side_all; ++side) fill_side(side);
    d_.sides[side_all] = {};  // every side now says it for itself
    for (int side = 0; side < side_all; ++side) {
      if (s_.sides[side].kind == SideKind::periodic && s_.sides[side ^ 1].kind != SideKind::periodic) {
        refuse("walls." + std::string(side_names[side]),
               fmt::format(R"("periodic" only together with walls.{} = "periodic")", side_names[side ^ 1]));
      }
    }
  }

  void check_side(int side) const {
    const std::string name = "walls." + std::string(side_names[side]);
    const SideInput& input = d_.sides[side];
    if (side == front || side == back) {
      for (const char* part : {"", ".fluid", ".solid", ".solid_friction", ".velocity"})
        only_in_3d(name + part);
    }
    if (input.word == SideWord::open && side != top) {
      refuse(name, R"("no-slip" | "slip" | "periodic"; only walls.top may be open)");
    }
    const bool coulomb = input.solid == WallKind::coulomb;
    if (coulomb && !input.solid_friction) {
      refuse(name + ".solid_friction", "a number >= 0, required with solid = \"coulomb\"");
    }
    if (!coulomb && input.solid_friction) refuse(name + ".solid_friction", "only with solid = \"coulomb\"");
    if (input.velocity.empty()) return;
    components(name + ".velocity", input.velocity);
    if (side == side_all || input.velocity[side / 2] != 0.0) {
      refuse(name + ".velocity", "a velocity in the plane of one side, its normal component 0");
    }
  }

  // Copies a side into the scene and states it in full in the draft.
  void fill_side(int side) {
    Side& to = s_.sides[side];
    SideInput& input = d_.sides[side];
    if (flat() && side >= front) {
      to.fluid.kind = to.solid.kind = WallKind::slip;
      input = {};
      return;
    }
    const bool own = input.word || input.fluid || input.solid || !input.velocity.empty();
    if (!own) input = d_.sides[side_all];
    if (input.word == SideWord::open || input.word == SideWord::periodic) {
      to.kind = input.word == SideWord::open ? SideKind::open : SideKind::periodic;
      return;
    }
    const WallKind both = input.word == SideWord::slip ? WallKind::slip : WallKind::no_slip;
    input.word.reset();
    input.fluid = input.fluid.value_or(both);
    input.solid = input.solid.value_or(both);
    to.fluid.kind = *input.fluid;
    to.solid = {*input.solid, input.solid_friction.value_or(0.0)};
    std::copy(input.velocity.begin(), input.velocity.end(), to.velocity.begin());
  }

  void materials() {
    if (!has("liquid")) s_.liquid = s_.gas;
    if (d_.level) {
      if (outside(0.0, *d_.level, 1))
        refuse("liquid.level", fmt::format("at most the tank's height {} m", s_.tank[1]));
      s_.liquid_boxes.push_back({{0.0, 0.0, 0.0}, {s_.tank[0], *d_.level, s_.tank[2]}});
    }
    if (d_.box_origin.empty() != d_.box_size.empty()) {
      refuse(d_.box_origin.empty() ? "liquid.box.origin" : "liquid.box.size",
             "box = { origin = [...], size = [...] }");
    }
    if (!d_.box_origin.empty()) liquid_box();
    const Contact& contact = s_.contact;
    if (contact.solid_fraction_min >= contact.solid_fraction_max) {
      refuse("contact.solid_fraction_min",
             fmt::format("below contact.solid_fraction_max = {}", contact.solid_fraction_max));
    }
    if ((s_.model.friction_law == FrictionLaw::inertial || s_.model.thin_layer_arrest) &&
        contact.fast_friction < s_.solid.friction) {
      refuse("contact.fast_friction", fmt::format("at least solid.friction = {}", s_.solid.friction));
    }
    if (s_.model.shear_dilatancy && (contact.critical_solid_fraction <= contact.solid_fraction_min ||
                                     contact.critical_solid_fraction >= contact.solid_fraction_max)) {
      refuse("contact.critical_solid_fraction",
             fmt::format("between contact.solid_fraction_min = {} and contact.solid_fraction_max = {}",
                         contact.solid_fraction_min, contact.solid_fraction_max));
    }
    if (contact.dense_solid_fraction > contact.solid_fraction_max) {
      refuse("contact.dense_solid_fraction",
             fmt::format("at most contact.solid_fraction_max = {}", contact.solid_fraction_max));
    }
  }

  void liquid_box() {
    components("liquid.box.origin", d_.box_origin);
    components("liquid.box.size", d_.box_size);
    Box box{{0.0, 0.0, 0.0}, s_.tank};
    for (int axis = 0; axis < s_.dimensions; ++axis) {
      box.lower[axis] = d_.box_origin[axis];
      box.upper[axis] = d_.box_origin[axis] + d_.box_size[axis];
      if (outside(box.lower[axis], box.upper[axis], axis)) {
        refuse("liquid.box.size",
               fmt::format("a box inside the tank: in {} it ends at {:.9g} m, the tank at {:.9g} m",
                           axis_names[axis], box.upper[axis], s_.tank[axis]));
      }
    }
    s_.liquid_boxes.push_back(box);
  }

  void bed() {
    needs("bed", "solid");
    if (!has("bed")) return;
    const double highest = s_.contact.solid_fraction_max;
    if (d_.bed.solid_fraction > highest) {
      refuse("bed.solid_fraction",
             fmt::format("a number in (0, {}], up to contact.solid_fraction_max", highest));
    }
    only_in_3d("bed.z");
    only_in_3d("bed.width");
    if (!flat()) d_.bed.z = d_.bed.z.value_or(0.0);
    if (!flat()) d_.bed.width = d_.bed.width.value_or(s_.tank[2] - *d_.bed.z);
    const double y = bed_bottom();
    d_.bed.y = y;
    const double z = d_.bed.z.value_or(0.0);
    const Box box{{d_.bed.x, y, z},
                  {d_.bed.x + d_.bed.length, y + d_.bed.height, z + d_.bed.width.value_or(s_.tank[2])}};
    const std::array<std::string, 3> extents{"bed.length", "bed.height", "bed.width"};
    for (int axis = 0; axis < 3; ++axis) {
      if (outside(box.lower[axis], box.upper[axis], axis) || box.upper[axis] <= box.lower[axis]) {
        refuse(extents[axis],
               fmt::format("a bed inside the tank: it begins at {} = {:.9g} m, the tank ends at {:.9g} m",
                           axis_names[axis], box.lower[axis], s_.tank[axis]));
      }
    }
    const bool banded = d_.bed.colour != ColourPattern::uniform;
    if (banded && !d_.bed.colour_size) {
      refuse("bed.colour_size",
             "a number > 0 [m], required with bed.colour = \"layers\", \"columns\" or \"checks\"");
    }
    if (!banded && d_.bed.colour_size) refuse("bed.colour_size", "only with bands (bed.colour)");
    s_.bed = Bed{box, d_.bed.solid_fraction, d_.bed.slope, d_.bed.colour, d_.bed.colour_size.value_or(0.0)};
    if (slope_reach(*s_.bed) > d_.bed.length * (1.0 + roundoff)) {
      refuse("bed.slope",
             fmt::format("a front face that fits bed.length = {} m: at least {:.4g} degrees", d_.bed.length,
                         std::atan2(d_.bed.height, d_.bed.length) * 180.0 / std::numbers::pi));
    }
  }

  static double slope_reach(const Bed& bed) {
    return bed.slope == 90.0
               ? 0.0
               : (bed.box.upper[1] - bed.box.lower[1]) / std::tan(bed.slope * std::numbers::pi / 180.0);
  }

  double bed_bottom() const {
    if (const double* y = std::get_if<double>(&d_.bed.y)) return *y;
    const BedPlace place = std::get<BedPlace>(d_.bed.y);
    if (place == BedPlace::floor) return 0.0;
    if (!d_.level) refuse("bed.y", "a number or \"floor\": the case has no liquid.level");
    if (place == BedPlace::on_water) return *d_.level;
    const double ratio = s_.solid.density / s_.liquid.density;
    if (ratio >= 1.0) refuse("bed.y", "\"floating\" only where solid.density is below liquid.density");
    const double y = *d_.level - ratio * d_.bed.height;
    if (y < 0.0)
      refuse("bed.y",
             fmt::format("liquid.level at least {:.9g} m for this bed to float", ratio * d_.bed.height));
    return y;
  }

  void gate() {
    needs("gate", "bed");
    if (d_.times.hold > 0.0 && !has("gate")) refuse("time.hold", "0: the case has no [gate] to hold the bed");
    if (!has("gate")) return;
    d_.gate_position = d_.gate_position.value_or(s_.bed->box.upper[0]);
    if (*d_.gate_position >= s_.tank[0]) {
      refuse("gate.position", fmt::format("inside the tank, below {} m", s_.tank[0]));
    }
    s_.gate = Gate{*d_.gate_position, d_.gate_speed};
  }

  void times() {
    TimesInput& t = d_.times;
    if (t.unit == TimeUnit::column) {
      if (!has("bed") || s_.gravity == 0.0) {
        refuse("time.unit", R"("s"; "column" needs a [bed] and gravity)");
      }
      s_.times.unit = std::sqrt(d_.bed.height / s_.gravity);
    }
    t.series_interval = t.series_interval.value_or(t.end / 200.0);
    if (*t.series_interval > t.end || t.end / *t.series_interval > most_rows) {
      refuse("output.series_interval", fmt::format("a number in [{:.9g}, {:.9g}], time.end / {} to time.end",
                                                   t.end / most_rows, t.end, most_rows));
    }
    s_.times.end = t.end * s_.times.unit;
    s_.times.hold = t.hold;
    for (const double time : regular_times(*t.series_interval, t.end))
      s_.times.row_times.push_back(time * s_.times.unit);
    s_.times.checkpoint_interval = t.checkpoint_interval;
  }

  int layer_of(const std::string& key) const {
    const auto found = text_.entries.find(key);
    return found == text_.entries.end() ? -1 : found->second.layer;
  }

  void fields() {
    TimesInput& t = d_.times;
    const int listed = layer_of("output.field_times");
    const int spaced = layer_of("output.field_interval");
    if (listed >= 0 && listed == spaced)
      refuse("output.field_interval", "either field_times or field_interval");
    if (spaced > listed) {
      if (*t.field_interval > t.end || t.end / *t.field_interval > most_field_times) {
        refuse("output.field_interval", fmt::format("a number in [{:.9g}, {:.9g}], time.end / {} to time.end",
                                                    t.end / most_field_times, t.end, most_field_times));
      }
      t.field_times = regular_times(*t.field_interval, t.end);
    } else if (listed < 0) {
      t.field_times = {0.0};
    } else {
      if (std::ranges::adjacent_find(t.field_times, std::greater_equal<>()) != t.field_times.end()) {
        refuse("output.field_times", "times in ascending order, each once");
      }
      if (layer_of("time.end") > listed)
        std::erase_if(t.field_times, [&](double time) { return time > t.end; });
      if (!t.field_times.empty() && t.field_times.back() > t.end) {
        refuse("output.field_times", fmt::format("times in [0, {}], up to time.end", t.end));
      }
    }
    t.field_interval.reset();
    if (t.field_times.empty() || t.field_times.back() < t.end) t.field_times.push_back(t.end);
    for (const double time : t.field_times) s_.times.field_times.push_back(time * s_.times.unit);
  }

  void numerics() const {
    const Numerics& n = s_.numerics;
    if (n.dt_min > n.dt_max)
      refuse("numerics.dt_min", fmt::format("at most numerics.dt_max = {} s", n.dt_max));
  }

  void reference() {
    needs("reference", "bed");
    ReferenceInput& input = d_.reference;
    ReferenceSettings& r = input.settings;
    if (flat() && !input.slice_depth) refuse("reference.slice_depth", "a number > 0 [m], required in 2D");
    if (!flat() && given("reference.slice_depth")) {
      refuse("reference.slice_depth", "no such key in 3D: tank.size has the depth");
    }
    if (r.dt * r.coarse_graining > r.fluid_dt) {
      refuse("reference.dt", fmt::format("at most reference.fluid_dt{} = {} s",
                                         r.coarse_graining > 1.0 ? " / reference.coarse_graining" : "",
                                         r.fluid_dt / r.coarse_graining));
    }
    if (r.seeds.empty()) refuse("reference.seeds", "at least one seed");
    const bool gated = has("gate");
    r.release =
        *(input.release = input.release.value_or(gated ? ReferenceRelease::gate : ReferenceRelease::instant));
    if (r.release == ReferenceRelease::gate && !gated) {
      refuse("reference.release", "\"instant\": the case has no [gate]");
    }
    r.hold = *(input.hold = input.hold.value_or(gated ? ReferenceSettings{}.hold : 0.0));
    r.slice_depth = input.slice_depth.value_or(s_.tank[2]);
    r.packing = *(input.packing = input.packing.value_or(d_.bed.solid_fraction));
    r.bead_friction = *(input.bead_friction = input.bead_friction.value_or(s_.solid.friction));
    r.bead_restitution = *(input.bead_restitution = input.bead_restitution.value_or(s_.solid.restitution));
    r.wall_friction = *(input.wall_friction = input.wall_friction.value_or(r.bead_friction));
    s_.reference = r;
  }

  Draft& d_;
  const CaseText& text_;
  Scene& s_;
};

}  // namespace

Scene complete(Draft& draft, const CaseText& text) {
  return Completion(draft, text).run();
}

}  // namespace granvof::case_file
