#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"

namespace granvof::case_file {
namespace {

double bottom_of(const Completion& c) {
  const auto& y = c.d.bed.y;
  if (const double* number = std::get_if<double>(&y)) return *number;
  const BedPlace place = std::get<BedPlace>(y);
  if (place == BedPlace::floor) return 0.0;
  if (!c.d.level) c.refuse("bed.y", "a number or \"floor\": the case has no liquid.level");
  if (place == BedPlace::on_water) return *c.d.level;
  const double ratio = c.s.solid.density / c.s.liquid.density;
  if (ratio >= 1.0) c.refuse("bed.y", "\"floating\" only where solid.density is below liquid.density");
  const double immersed = ratio * c.d.bed.filled.value_or(c.d.bed.height);
  const double bottom = *c.d.level - immersed;
  if (bottom < 0.0) {
    c.refuse("bed.y", fmt::format("liquid.level at least {:.9g} m for this bed to float", immersed));
  }
  return bottom;
}

double width_of(const Completion& c) {
  return c.d.bed.width.value_or(c.s.tank[2] - c.d.bed.z.value_or(0.0));
}

// The height that a stated volume of solid fills.
void fill(const Completion& c) {
  BedInput& bed = c.d.bed;
  if (bed.slope != 90.0) c.refuse("bed.solid_volume", "only with an upright front face (bed.slope = 90)");
  const double per_height = bed.solid_fraction * bed.length * width_of(c);
  const double height = *bed.solid_volume / per_height;
  if (!(height <= bed.height * (1.0 + roundoff))) {
    c.refuse("bed.solid_volume", fmt::format("at most {:.9g} m3, what the bed holds at bed.solid_fraction",
                                             per_height * bed.height));
  }
  bed.filled = height;
}

void place(const Completion& c) {
  BedInput& bed = c.d.bed;
  c.only_in_3d("bed.z");
  c.only_in_3d("bed.width");
  if (!c.flat()) bed.z = bed.z.value_or(0.0);
  if (!c.flat()) bed.width = width_of(c);
  const double y = bottom_of(c);
  bed.y = y;
  const double z = bed.z.value_or(0.0);
  const Box box{{bed.x, y, z}, {bed.x + bed.length, y + bed.filled.value_or(bed.height), z + width_of(c)}};
  const std::array<std::string, 3> extents{"bed.length", "bed.height", "bed.width"};
  for (int axis = 0; axis < 3; ++axis) {
    if (c.outside(box.lower[axis], box.upper[axis], axis) ||
        box.upper[axis] - box.lower[axis] <= roundoff * c.s.tank[axis]) {
      c.refuse(extents[axis],
               fmt::format("a bed inside the tank: it begins at {} = {:.9g} m, the tank ends at {:.9g} m",
                           "xyz"[axis], box.lower[axis], c.s.tank[axis]));
    }
  }
  c.s.bed = Bed{box, bed.solid_fraction, bed.slope, bed.colour, bed.colour_size.value_or(0.0), bed.height};
}

void bands(const Completion& c) {
  const BedInput& bed = c.d.bed;
  const bool banded = bed.colour != ColourPattern::uniform;
  if (banded && !bed.colour_size) {
    c.refuse("bed.colour_size",
             "a number > 0 [m], required with bed.colour = \"layers\", \"columns\" or \"checks\"");
  }
  if (!banded && bed.colour_size) c.refuse("bed.colour_size", "only with bands (bed.colour)");
}

double slope_reach(const BedInput& bed) {
  return bed.slope == 90.0 ? 0.0 : bed.height / std::tan(bed.slope * std::numbers::pi / 180.0);
}

void front_face(const Completion& c) {
  const BedInput& bed = c.d.bed;
  if (slope_reach(bed) > bed.length * (1.0 + roundoff)) {
    c.refuse("bed.slope",
             fmt::format("a front face that fits bed.length = {} m: at least {:.4g} degrees", bed.length,
                         std::atan2(bed.height, bed.length) * 180.0 / std::numbers::pi));
  }
}

void stand(const Completion& c) {
  const double x = *(c.d.gate_position = c.d.gate_position.value_or(c.s.bed->box.upper[0]));
  const double cell = c.s.grid.spacing[0], length = c.s.tank[0];
  const bool joined = c.s.sides[left].kind == SideKind::periodic;  // then a face of cells like any other
  const double margin = joined ? -roundoff * length : cell * (0.5 + roundoff);
  if (x < margin || x > length - margin) {
    c.refuse("gate.position",
             joined ? fmt::format("inside the tank, at most {} m", length)
                    : fmt::format("inside the tank, below {} m, with a cell of {:.9g} m on each side", length,
                                  cell));
  }
  const Box& bed = c.s.bed->box;
  if (x > bed.lower[0] + roundoff * length && x < bed.upper[0] - roundoff * length) {
    c.refuse("gate.position",
             fmt::format("beside the bed, which stands from {:.9g} to {:.9g} m", bed.lower[0], bed.upper[0]));
  }
  c.s.gate = Gate{x, c.d.gate_speed};
}

}  // namespace

void complete_bed(Completion& c) {
  c.rule({"bed", "solid"}, [&] { c.needs("bed", "solid"); });
  if (!c.has("bed")) return;
  c.rule({"bed.solid_fraction", "contact.solid_fraction_max"}, [&] {
    const double highest = c.s.contact.solid_fraction_max;
    if (c.d.bed.solid_fraction > highest) {
      c.refuse("bed.solid_fraction",
               fmt::format("a number in (0, {}], up to contact.solid_fraction_max", highest));
    }
  });
  if (c.d.bed.solid_volume) {
    c.rule({"tank", "bed.solid_volume", "bed.solid_fraction", "bed.slope", "bed.z", "bed.length",
            "bed.height", "bed.width"},
           [&] { fill(c); });
  }
  c.rule({"scene.dimensions", "tank", "liquid.level", "liquid.density", "solid.density", "bed.x", "bed.y",
          "bed.z", "bed.length", "bed.height", "bed.width"},
         [&] { place(c); });
  c.rule({"bed.colour", "bed.colour_size"}, [&] { bands(c); });
  c.rule({"bed.slope", "bed.length", "bed.height"}, [&] { front_face(c); });
}

void complete_gate(Completion& c) {
  c.rule({"gate", "bed"}, [&] { c.needs("gate", "bed"); });
  c.rule({"time.hold", "gate"}, [&] {
    if (c.d.times.hold > 0.0 && !c.has("gate")) {
      c.refuse("time.hold", "0: the case has no [gate] to hold the bed");
    }
  });
  // Without a bed in its place the gate has nothing to stand by.
  if (c.has("gate") && c.s.bed) c.rule({"gate", "tank", "grid", "walls"}, [&] { stand(c); });
}

}  // namespace granvof::case_file
