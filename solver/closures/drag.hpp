// Drag coefficient of the grains in the continuous phase: the law that model.drag_law names, for both codes.
//
// beta_c = alpha beta_l + (1 - alpha) beta_g (below eq (8)). A law is a function object of one fluid,
// law(f_s, slip, fluid, d_s) -> beta [kg/m3 s]; with_drag_law() picks it once, outside the loop over cells.
#pragma once

#include <algorithm>
#include <numbers>

#include "solver/closures/drag_beetstra.hpp"
#include "solver/closures/drag_di_felice.hpp"
#include "solver/closures/drag_paper.hpp"
#include "solver/closures/drag_tenneti.hpp"
#include "solver/scene/scene.hpp"

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

// A solid fraction that no law tells from 0.
inline constexpr double lone_grain = 1e-30;

// body(law) with the law of that name.
template <typename Body>
decltype(auto) with_drag_law(DragLaw law, Body&& body) {
  const auto of = [](auto force) {
    return [force](double f_s, double slip, const Fluid& fluid, double d_s) {
      return drag_of_force(force, f_s, slip, fluid, d_s);
    };
  };
  switch (law) {
    case DragLaw::di_felice:
      return body(of([](double f_s, double re) { return drag_force_di_felice(f_s, re); }));
    case DragLaw::beetstra:
      return body(of([](double f_s, double re) { return drag_force_beetstra(f_s, re); }));
    case DragLaw::tenneti:
      return body(of([](double f_s, double re) { return drag_force_tenneti(f_s, re); }));
    case DragLaw::paper:
      break;
  }
  return body([](double f_s, double slip, const Fluid& fluid, double d_s) {
    return drag_paper(f_s, slip, fluid, d_s);
  });
}

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
