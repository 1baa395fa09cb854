// What the element tests of a case's beads say of its material, as the solver's keys have it.
#pragma once

#include <optional>
#include <string>

#include "reference/demvof/bulk_friction/chute.hpp"
#include "reference/demvof/element/first_flow.hpp"
#include "reference/demvof/element/measured.hpp"
#include "reference/demvof/element/packing_at_rest.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

struct ElementTests {
  ChuteResult chute;
  FrictionFit friction;          // of long flow: of the chute's windows
  std::vector<FirstFlow> first;  // a seed each
  FrictionFit first_friction;    // of first strain, and where that is too slow of the chute's fast flow
  PackingAtRest loosest, densest;
  Measured critical;             // f_s of slow flow: I -> 0 on the chute [-]
  double critical_load = 0.0;    // of the windows that gave it [Pa]
  Measured restitution;          // of smooth spheres that cool alike [-]
  std::optional<Measured> wall;  // nothing where walls are without friction
};

inline constexpr double slow_flow = 0.15;  // largest I of the line that gives the critical packing [-]

// Solid fraction at which grains touch, so that (13) bears `load` [Pa] at `solid_fraction`: what the law
// takes as f_s,min. load >= 0.
double touching_fraction(const granvof::Contact& contact, double solid_fraction, double load);

// mu(I) of the windows of first strain, least_strain to largest_strain, and of all that are faster than
// slow_flow, the chute's too: there both agree. std::invalid_argument where there are too few.
FrictionFit fit_of_first(const std::vector<FirstFlow>& first, const ChuteResult& chute);

// From the windows of slow flow. std::invalid_argument where there are too few.
Measured critical_packing(const ChuteResult& chute, double& load);

// A piece of a case file, [solid] and [contact], that a case takes over with `base`: friction of first
// strain, packings; numbers with three or four digits and their bands in comments. Distances of
// contact.dense_solid_fraction and contact.solid_fraction_max from f_s,min stay those of `scene`, whose
// stiffness and exponent it needs beside it.
std::string material_text(const granvof::Scene& scene, const ElementTests& tests);

}  // namespace demvof
