// Drag coefficient of the grains in the continuous phase, for both codes.
//
// beta_c = alpha beta_l + (1 - alpha) beta_g (below eq (8)). A law is a function object of one fluid,
// law(f_s, slip, fluid, d_s) -> beta [kg/m3 s]; DragLaw::with() picks it once, outside the loop over cells.
// Equations: docs/theory/drag.md.
#pragma once

#include <algorithm>
#include <numbers>

#include "solver/closures/drag/laws.hpp"
#include "solver/model/fluid.hpp"

namespace granvof::closures {

// A solid fraction that no law tells from 0.
inline constexpr double lone_grain = 1e-30;

// beta_c [kg/m3 s] of the mixture of liquid (share alpha of the continuous phase, in [0, 1]) and gas.
template <typename Law>
double drag_coefficient(Law law, double f_s, double alpha, double slip, const Fluid& gas, const Fluid& liquid,
                        double d_s) {
  double beta = 0.0;
  if (alpha > 0.0) beta += alpha * law(f_s, slip, liquid, d_s);
  if (alpha < 1.0) beta += (1.0 - alpha) * law(f_s, slip, gas, d_s);
  return beta;
}

// Coefficient of (u_c - u_s) on one grain [kg/s]: beta / f_s times its volume, finite for the lone grain.
template <typename Law>
double drag_on_grain(Law law, double f_s, double alpha, double slip, const Fluid& gas, const Fluid& liquid,
                     double d_s) {
  const double f = std::max(f_s, lone_grain);
  return drag_coefficient(law, f, alpha, slip, gas, liquid, d_s) / f * std::numbers::pi / 6.0 * d_s * d_s *
         d_s;
}

}  // namespace granvof::closures
