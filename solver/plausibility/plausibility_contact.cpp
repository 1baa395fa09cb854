// Rows of [contact]: the law's parameters.
#include <cmath>

#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/scales.hpp"

namespace granvof::plausible {
namespace {

// Stiffness that bears the bed's weight within half of the packings at which grains touch [Pa], by (13).
double bearing_stiffness(const Scene& s) {
  const double half = 0.5 * (s.contact.solid_fraction_max - s.contact.solid_fraction_min);
  return s.solid.density * s.gravity * bed_height(s) / std::pow(half, s.contact.exponent);
}

}  // namespace

std::vector<Row> contact_rows() {
  const auto of_bed = [](auto member) {
    return [member](const Scene& s) { return if_bed(s, member(s.contact)); };
  };
  return {
      row(
          "contact.stiffness", "Pa", of_bed([](const Contact& c) { return c.stiffness; }),
          [](const Scene& s) {
            return Usual{bearing_stiffness(s), stiffest};
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
            return Usual{1e3 * scales_of(s).time(), 1e15 * scales_of(s).time()};
          },
          "grains at rest creep within the time in which the scene changes, or rounding keeps them from it"),
      row(
          "contact.fast_friction", "",
          [](const Scene& s) {  // what solid.friction is itself is said of that
            return s.contact.fast_friction == s.solid.friction ? std::nullopt
                                                               : if_bed(s, s.contact.fast_friction);
          },
          Usual{0.05, steepest}, "the tangent of an angle; degrees?"),
      row("contact.inertial_number", "", of_bed([](const Contact& c) { return c.inertial_number; }),
          Usual{0.01, 2.0}, "glass beads have 0.28"),
      row("contact.dilatancy_rate", "", of_bed([](const Contact& c) { return c.loosening_factor; }),
          Usual{0.1, 5.0}, "suspensions of spheres have 1"),
      row("contact.viscous_number", "", of_bed([](const Contact& c) { return c.viscous_number; }),
          Usual{5e-4, 0.05}, "spheres have 0.005"),
      row("contact.stop_length", "", of_bed([](const Contact& c) { return c.stop_length; }), Usual{0.3, 20.0},
          "in grain diameters; glass beads have 1.65"),
      row("contact.dilatancy_factor", "", of_bed([](const Contact& c) { return c.flow_law_factor; }),
          Usual{0.01, 10.0}, "spheres have 0.28"),
      row("contact.dilatancy_exponent", "", of_bed([](const Contact& c) { return c.flow_law_exponent; }),
          Usual{0.05, 5.0}, "spheres have 0.58"),
      row("contact.dense_solid_fraction", "", of_bed([](const Contact& c) { return c.dense_solid_fraction; }),
          of_random_packing,
          "where (15) takes over from collisions, among the packings at which grains touch"),
      row("contact.critical_solid_fraction", "",
          of_bed([](const Contact& c) { return c.critical_solid_fraction; }), of_random_packing,
          "the packing under slow shear; spheres have 0.58"),
      row("contact.dilatancy_slope", "", of_bed([](const Contact& c) { return c.dilatancy_slope; }),
          Usual{0.1, 50.0}, "glass beads have 4"),
  };
}

}  // namespace granvof::plausible
