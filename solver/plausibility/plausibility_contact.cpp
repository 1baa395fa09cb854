// Rows of [contact]: the law's parameters, and those of choices that are not made.
#include <cmath>
#include <string>
#include <string_view>

#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/scales.hpp"

namespace granvof::plausible {
namespace {

// Stiffness that bears the bed's weight within half of the packings at which grains touch [Pa], by (13).
double bearing_stiffness(const Scene& s) {
  const double half = 0.5 * (s.contact.solid_fraction_max - s.contact.solid_fraction_min);
  return s.solid.density * s.gravity * bed_height(s) / std::pow(half, s.contact.exponent);
}

std::string friction_laws_that_read(std::string_view key) {
  return "model.friction_law = " + closures::words_that_read<closures::FrictionLaws>(key);
}

}  // namespace

std::vector<Row> contact_rows() {
  const auto of_bed = [](auto member) {
    return [member](const Scene& s) { return if_bed(s, member(s.contact)); };
  };
  const auto model = [](auto member) { return [member](const Scene& s) { return member(s.model); }; };
  const auto shear = model([](const Model& m) { return m.shear_dilatancy; });
  const auto arrest = model([](const Model& m) { return m.thin_layer_arrest; });
  const auto friction_law = model([](const Model& m) { return m.friction_law.facts(); });
  const auto law_reads = [=](std::string_view key) {
    return [=](const Scene& s) { return friction_law(s).reads_key(key); };
  };
  const auto fast = [=](const Scene& s) { return arrest(s) || law_reads("contact.fast_friction")(s); };
  const auto by_rate = model(
      [](const Model& m) { return m.shear_dilatancy && m.critical_packing == CriticalPacking::by_rate; });
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
            return Usual{1e3 * scales_of(s).time(), infinity};
          },
          "grains at rest creep within the time in which the scene changes"),
      row("contact.fast_friction", "", of_bed([](const Contact& c) { return c.fast_friction; }),
          Usual{0.05, steepest}, "the tangent of an angle; degrees?"),
      row("contact.inertial_number", "", of_bed([](const Contact& c) { return c.inertial_number; }),
          Usual{0.01, 2.0}, "glass beads have 0.28"),
      row("contact.dilatancy_rate", "", of_bed([](const Contact& c) { return c.dilatancy_rate; }),
          Usual{0.1, 5.0}, "suspensions of spheres have 1"),
      row("contact.viscous_number", "", of_bed([](const Contact& c) { return c.viscous_number; }),
          Usual{5e-4, 0.05}, "spheres have 0.005"),
      row("contact.stop_length", "", of_bed([](const Contact& c) { return c.stop_length; }), Usual{0.3, 20.0},
          "in grain diameters; glass beads have 1.65"),
      idle(
          "contact.critical_solid_fraction", [](const Contact& c) { return c.critical_solid_fraction; },
          shear, "model.shear_dilatancy"),
      idle(
          "contact.dilatancy_slope", [](const Contact& c) { return c.dilatancy_slope; }, shear,
          "model.shear_dilatancy"),
      idle(
          "contact.dilatancy_rate", [](const Contact& c) { return c.dilatancy_rate; }, by_rate,
          "model.shear_dilatancy and model.critical_packing = \"by-rate\""),
      idle(
          "contact.viscous_number", [](const Contact& c) { return c.viscous_number; },
          law_reads("contact.viscous_number"), friction_laws_that_read("contact.viscous_number")),
      idle(
          "contact.stop_length", [](const Contact& c) { return c.stop_length; }, arrest,
          "model.thin_layer_arrest"),
      idle(
          "contact.fast_friction", [](const Contact& c) { return c.fast_friction; }, fast,
          friction_laws_that_read("contact.fast_friction") + ", or model.thin_layer_arrest"),
      idle(
          "contact.inertial_number", [](const Contact& c) { return c.inertial_number; },
          law_reads("contact.inertial_number"), friction_laws_that_read("contact.inertial_number")),
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

}  // namespace granvof::plausible
