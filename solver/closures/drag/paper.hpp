// Drag of the paper, eqs (8) and (9): Ergun where f_c < 0.8, Wen & Yu above, with C_D of eq (9).
//
// C_D Re is evaluated instead of C_D, so that nothing diverges at Re -> 0. The printed branches do not meet
// at f_c = 0.8 (a factor 1.44 at Re -> 0); they are blended linearly over f_c in [0.78, 0.82]. As printed,
// Wen & Yu's f_c^-1.65 stands with Re of the slip itself, not of f_c times the slip as in Wen & Yu (1966):
// slow suspensions settle with the exponent 3.65, where Richardson & Zaki have 4.65.
// Equations: docs/theory/drag.md.
#pragma once

#include <cmath>

#include "solver/model/choices.hpp"
#include "solver/model/fluid.hpp"

namespace granvof::closures {

// C_D Re of eq (9) [-]; Re >= 0. Stokes' 24 at Re = 0.
inline double drag_times_reynolds(double re) {
  return 24.0 + 0.4 * re + 6.0 * re / (1.0 + std::sqrt(re));
}

// Lower branch of (8) [kg/m3 s]: packed bed (Ergun). f_s in [0, 1), slip = |u_c - u_s| [m/s].
inline double drag_ergun(double f_s, double slip, const Fluid& fluid, double d_s) {
  const double f_c = 1.0 - f_s;
  return 150.0 * f_s * f_s * fluid.viscosity / (f_c * d_s * d_s) + 1.75 * fluid.density * f_s * slip / d_s;
}

// Upper branch of (8) [kg/m3 s]: dispersed grains (Wen & Yu), C_D Re form.
inline double drag_wen_yu(double f_s, double slip, const Fluid& fluid, double d_s) {
  const double f_c = 1.0 - f_s;
  // Re is needed only times mu: an inviscid fluid keeps its form drag.
  const double re = fluid.viscosity > 0.0 ? fluid.density * slip * d_s / fluid.viscosity : 0.0;
  const double c_d_re_mu =
      fluid.viscosity > 0.0 ? drag_times_reynolds(re) * fluid.viscosity : 0.4 * fluid.density * slip * d_s;
  return 0.75 * c_d_re_mu * f_s * std::pow(f_c, -1.65) / (d_s * d_s);
}

inline constexpr double drag_blend_lower = 0.78;  // f_c below which (8) is Ergun alone
inline constexpr double drag_blend_upper = 0.82;  // f_c above which (8) is Wen & Yu alone

// One fluid's drag coefficient [kg/m3 s], eq (8), f_s in [0, 1).
inline double drag_paper(double f_s, double slip, const Fluid& fluid, double d_s) {
  const double f_c = 1.0 - f_s;
  if (f_c <= drag_blend_lower) return drag_ergun(f_s, slip, fluid, d_s);
  if (f_c >= drag_blend_upper) return drag_wen_yu(f_s, slip, fluid, d_s);
  const double w = (f_c - drag_blend_lower) / (drag_blend_upper - drag_blend_lower);
  return (1.0 - w) * drag_ergun(f_s, slip, fluid, d_s) + w * drag_wen_yu(f_s, slip, fluid, d_s);
}

struct DragPaper {
  static constexpr ClosureFacts facts{"paper", "(8), (9) as printed"};

  double operator()(double f_s, double slip, const Fluid& fluid, double d_s) const {
    return drag_paper(f_s, slip, fluid, d_s);
  }
};

}  // namespace granvof::closures
