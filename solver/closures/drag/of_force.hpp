// A law of drag that is given as the force on a grain.
#pragma once

#include <algorithm>

#include "solver/model/fluid.hpp"

namespace granvof::closures {

// Largest Reynolds number a force F(f_s, Re) is asked for: stands for the inviscid fluid, where mu F tends to
// a limit that goes with rho U d.
inline constexpr double largest_reynolds = 1e12;

// beta [kg/m3 s] from the force on a grain, F = drag / (3 pi mu d U), U = f_c slip: 6 f_s / (pi d^3) grains a
// volume make beta = 18 mu f_s f_c F / d^2. f_s in [0, 1), slip = |u_c - u_s| >= 0 [m/s], d_s [m] > 0.
template <typename Force>
double drag_of_force(Force force, double f_s, double slip, const Fluid& fluid, double d_s) {
  const double f_c = 1.0 - f_s, inertia = fluid.density * f_c * slip * d_s;
  const double mu = std::max(fluid.viscosity, inertia / largest_reynolds);
  return mu > 0.0 ? 18.0 * mu * f_s * f_c * force(f_s, inertia / mu) / (d_s * d_s) : 0.0;
}

// The law(f_s, slip, fluid, d_s) -> beta [kg/m3 s] of Law::force(f_s, Re).
template <typename Law>
struct DragOfForce {
  double operator()(double f_s, double slip, const Fluid& fluid, double d_s) const {
    return drag_of_force([](double f, double re) { return Law::force(f, re); }, f_s, slip, fluid, d_s);
  }
};

}  // namespace granvof::closures
