// States without gradients, which the printed laws alone decide: grains that settle evenly, and grains
// sheared evenly between two walls. Every law is stated here once more, apart from the solver's closures, as
// its source has it; a slip in either shows.
#pragma once

#include <optional>

#include "solver/scene/scene.hpp"

namespace granvof::compare {

// beta [kg/m3 s] of the scene's drag law in the fluid between its grains: (8), (9); Di Felice (1994);
// Beetstra et al. (2007); Tenneti et al. (2011). f_s in (0, 1), slip = |u_c - u_s| >= 0 [m/s]; the jump of
// (8) is spread over f_c = 0.78 to 0.82. With a [liquid] the pores are full of it.
double printed_drag(const Scene& scene, double f_s, double slip);

// u_c - u_s [m/s] of an even suspension that settles in a closed tank: beta w = f_s f_c (rho_s - rho_c) g,
// (5) and (6) without acceleration and net flow, at the bed's solid fraction. Nothing without a bed or drag.
std::optional<double> printed_settling_slip(const Scene& scene);

// What grains at the bed's solid fraction do in steady shear between a floor and a lid that move in x, as far
// apart as the bed is high: a bed that fills the tank, or all that obstacles on the floor leave of it.
struct EvenShear {
  double theta = 0.0;     // granular temperature [m2/s2], from production = collisions + drag, (7)
  double energy = 0.0;    // 3/2 f_s rho_s Theta [J/m3]
  double pressure = 0.0;  // P_s [Pa], (11) to (15) and that of viscous contacts
  double contacts = 0.0;  // what friction (17) and collisions (23) take [W/m3]
  double drag = 0.0;      // 3 beta Theta of (7) [W/m3]
  double fluid = 0.0;     // what the fluid's viscosity takes, (10) included [W/m3]
};

// Nothing without a bed, moving walls, or Theta of its own equation; nor with a critical
// packing that follows the rate, correlated collisions, or friction of the whole stress.
std::optional<EvenShear> printed_even_shear(const Scene& scene);

}  // namespace granvof::compare
