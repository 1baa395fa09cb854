// Rows of [bed] and of [gate], which holds it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/closures/elastic_energy.hpp"
#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/gravity.hpp"
#include "solver/scene/parts.hpp"
#include "solver/scene/scales.hpp"

namespace granvof::plausible {
namespace {

// Energy that the contacts of the bed hold at solid fraction f, over that of its own height above its base
// [-].
double springs(const Scene& s, double f) {
  const closures::ElasticEnergy energy(s.contact);
  return energy(f, s.contact.solid_fraction_min) / (f * s.solid.density * s.gravity * 0.5 * bed_height(s));
}
bool may_spring(const Scene& s) {
  return s.bed && s.gravity > 0.0 && !s.model.carries_packing() &&
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

// Grains flow down an incline without an end, sheared by mu(I), a law of the whole stress, and by collisions.
bool counts_rate_twice(const Scene& s) {
  Model whole = s.model;
  whole.whole_stress_friction = true;
  return s.bed && gravity_of(s)[0] != confined_gravity(s)[0] &&
         s.sides[bottom].solid.kind == WallKind::no_slip && word_of(s.model.friction_law) == "inertial" &&
         whole.bounds_collisions() && !s.model.bounds_collisions();
}

// Grains that the bed holds, were it as deep as the tank.
double grains_of_bed(const Scene& s) {
  const Box& bed = s.bed->box;
  double volume = s.bed->solid_fraction;
  for (int axis = 0; axis < 3; ++axis) volume *= extent(bed, axis) > 0.0 ? extent(bed, axis) : s.tank[2];
  return volume / (std::numbers::pi / 6.0 * std::pow(s.solid.diameter, 3));
}

// Of the bed along the axis, or the axes, in which its bands follow each other [m].
double longest_of_bands(const Scene& s) {
  const double along = extent(s.bed->box, 0), up = extent(s.bed->box, 1);
  if (s.bed->colour == ColourPattern::layers) return up;
  return s.bed->colour == ColourPattern::columns ? along : std::max(along, up);
}

double off_the_bed(const Scene& s) {
  const Box& bed = s.bed->box;
  return std::min(std::fabs(s.gate->position - bed.lower[0]), std::fabs(s.gate->position - bed.upper[0]));
}

// Where the cells let the plate stand: on the face nearest to gate.position.
double face_of_gate(const Scene& s) {
  const double h = s.grid.spacing[0];
  return h * std::round(s.gate->position / h);
}

}  // namespace

std::vector<Row> bed_rows() {
  return {
      missing(
          "bed", [](const Scene& s) { return !has_grains(s) && s.solid != Solid{}; }, "a table [bed]",
          "the case has a [solid], but no grains in the tank, and none come in"),
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
                "with model.packing = \"uniform\" a bed denser than contact.solid_fraction_min = {} springs: "
                "its "
                "contacts hold {:.3g} times the energy of its own height",
                s.contact.solid_fraction_min, springs(s, s.bed->solid_fraction));
          }),
      row(
          "bed.solid_fraction", "",
          [](const Scene& s) { return s.bed && is_grain(s) ? Number(s.bed->solid_fraction) : std::nullopt; },
          [](const Scene& s) {
            return Usual{s.bed->solid_fraction / grains_of_bed(s), infinity};
          },
          "the bed holds not one grain of solid.diameter"),
      row(
          "tank.inclination", "degrees",
          [](const Scene& s) {
            return counts_rate_twice(s) ? Number(std::fabs(s.inclination)) : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{0.0, std::atan(s.solid.friction) * 180.0 / std::numbers::pi};
          },
          "grains that run down an incline are held by mu(I) and by collisions, which count the rate of "
          "shear twice: "
          "model.whole_stress_friction = true counts it once"),
      row(
          "bed.colour_size", "m",
          [](const Scene& s) {
            return s.bed && s.bed->colour != ColourPattern::uniform ? Number(s.bed->colour_size)
                                                                    : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{smallest_cell(s), longest_of_bands(s)};
          },
          "bands finer than a cell are grey, and one that the bed fills alone shows no mixing"),
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
      {"gate.position",
       [](const Scene& s) -> std::optional<Implausible> {
         if (!s.gate) return std::nullopt;
         const double face = face_of_gate(s);
         if (std::fabs(s.gate->position - face) <= off_a_face * s.grid.spacing[0]) return std::nullopt;
         return Implausible{"gate.position", fmt::format("{:.9g} m", s.gate->position),
                            fmt::format("a face of the cells, the nearest {:.9g} m", face),
                            "the plate stands on that face, beside its place"};
       }},
      row(
          "gate.speed", "m/s", [](const Scene& s) { return if_gate(s, s.gate->speed); },
          [](const Scene& s) {
            return Usual{0.1 * std::sqrt(s.gravity * bed_height(s)), 50.0};
          },
          "from slower than the collapse it sets free to that of a shot; mm/s?"),
  };
}

}  // namespace granvof::plausible
