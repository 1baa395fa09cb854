// Rows of [reference]: how the beads of the DEM-VOF run are resolved in space and time, and what they are
// like.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/scales.hpp"

namespace granvof::plausible {
namespace {

// Time in which a Rayleigh wave crosses half of a grain [s]: pi d / 2 sqrt(rho_s / G) / (0.1631 nu + 0.8766),
// G = E / 2 (1 + nu) (Ning and Ghadiri, Chem. Eng. Sci. 61 (2006) 5991). Limits: E > 0, -1 < nu < 0.5.
double rayleigh_time(const Solid& grains, const ReferenceSettings& r) {
  const double shear_modulus = 0.5 * r.young / (1.0 + r.poisson);
  return 0.5 * std::numbers::pi * grains.diameter * std::sqrt(grains.density / shear_modulus) /
         (0.1631 * r.poisson + 0.8766);
}
constexpr Usual of_rayleigh_time{1e-4, 0.4};  // a step of the beads; records have 0.1 to 0.2

// What the bed's own height presses together by a fifth of a bead (Hertz: (P / E)^(2/3)) is no bead [Pa].
constexpr double least_stiffness = 10.0;  // of its weight per area
double softest(const Scene& s) {
  return least_stiffness * s.solid.density * s.gravity * bed_height(s);
}

double bead(const Scene& s) {
  return s.reference->coarse_graining * s.solid.diameter;
}

}  // namespace

std::vector<Row> reference_rows() {
  using Settings = ReferenceSettings;
  const auto of = [](auto member) {
    return [member](const Scene& s) -> Number {
      return s.reference ? Number(member(*s.reference)) : std::nullopt;
    };
  };
  // Where nothing is stated it follows another key, and is judged there.
  const auto own = [](auto member, auto otherwise) {
    return [member, otherwise](const Scene& s) -> Number {
      return s.reference && member(s) != otherwise(s) ? Number(member(s)) : std::nullopt;
    };
  };
  const auto bead_friction = [](const Scene& s) { return s.reference->bead_friction; };
  const auto wall_friction = [](const Scene& s) { return s.reference->wall_friction; };
  const auto if_grain = [of](auto member) {
    return [member, of](const Scene& s) { return is_grain(s) && s.bed ? of(member)(s) : std::nullopt; };
  };
  const char* const tangent = "the tangent of an angle; degrees?";
  return {
      row(
          "reference.cell", "m", if_grain([](const Settings& r) { return r.cell; }),
          [](const Scene& s) {
            return Usual{bead(s), 0.5 * shortest_of_bed(s)};
          },
          "a cell of the fluid averages over beads, and the bed is some cells high and long"),
      flow_step_row("reference.fluid_dt", of([](const Settings& r) { return r.fluid_dt; })),
      row(
          "reference.dt", "s", if_grain([](const Settings& r) { return r.dt; }),
          [](const Scene& s) {
            const double time = rayleigh_time(s.solid, *s.reference);
            return Usual{of_rayleigh_time.lower * time, of_rayleigh_time.upper * time};
          },
          [](const Scene& s) {
            return fmt::format(
                "a wave crosses a bead in {:.3g} s (Rayleigh, by reference.young): longer steps miss "
                "contacts, "
                "far shorter ones only cost",
                rayleigh_time(s.solid, *s.reference));
          }),
      row(
          "reference.slice_depth", "m",
          [=](const Scene& s) {
            return s.dimensions == 2 ? if_grain([](const Settings& r) { return r.slice_depth; })(s)
                                     : std::nullopt;
          },
          [](const Scene& s) {
            return Usual{2.0 * bead(s), std::max(s.tank[0], s.tank[1])};
          },
          "beads of a slice touch themselves around its periodic end, or it holds more than the tank's face"),
      row(
          "reference.hold", "s",
          [=](const Scene& s) { return s.reference ? positive(s.reference->hold) : std::nullopt; },
          [](const Scene& s) {
            return Usual{shortest_step * scales_of(s).time(), longest_hold * scales_of(s).time()};
          },
          "a bed that the gate holds rests in some times of the scene; the run begins after it"),
      row(
          "reference.young", "Pa", if_grain([](const Settings& r) { return r.young; }),
          [](const Scene& s) {
            return Usual{softest(s), stiffest};
          },
          "from what the bed's weight presses into itself by a fifth of a bead to diamond"),
      row("reference.poisson", "", of([](const Settings& r) { return r.poisson; }), Usual{0.0, 0.5},
          "a material that grows thicker as it is stretched; glass has 0.2"),
      row("reference.bead_friction", "", own(bead_friction, [](const Scene& s) { return s.solid.friction; }),
          of_friction, tangent),
      row("reference.bead_rolling_friction", "",
          of([](const Settings& r) { return r.bead_rolling_friction; }), of_friction, tangent),
      row("reference.bead_restitution", "",
          own([](const Scene& s) { return s.reference->bead_restitution; },
              [](const Scene& s) { return s.solid.restitution; }),
          of_restitution, "glass beads have 0.9; at 1 agitation never decays"),
      row("reference.wall_friction", "", own(wall_friction, bead_friction), of_friction, tangent),
      row("reference.gate_friction", "",
          own([](const Scene& s) { return s.reference->gate_friction; }, wall_friction), of_friction,
          tangent),
      row("reference.packing", "",
          own([](const Scene& s) { return s.reference->packing; },
              [](const Scene& s) { return s.bed ? s.bed->solid_fraction : s.reference->packing; }),
          of_random_packing, "that of grains that lie on each other"),
      row("reference.preparation_friction", "", of([](const Settings& r) { return r.preparation_friction; }),
          of_friction, tangent),
      row("reference.preparation_rolling_friction", "",
          of([](const Settings& r) { return r.preparation_rolling_friction; }), of_friction, tangent),
  };
}

}  // namespace granvof::plausible
