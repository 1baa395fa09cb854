// Drag on a grain of a suspension: R. Di Felice, Int. J. Multiphase Flow 20 (1994) 153.
//
// The lone grain's drag at the superficial velocity U = f_c |u_c - u_s| (Dallavalle's C_D) times f_c^-chi,
// chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2). Slow and fast suspensions settle as U ~ f_c^(1 + chi) and U
// ~ f_c^((1 + chi) / 2): Richardson & Zaki's exponents. C_D Re -> 4.8^2 at Re -> 0, 4 % below Stokes.
#pragma once

#include <cmath>

#include "solver/closures/drag/of_force.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

struct DragDiFelice : DragOfForce<DragDiFelice> {
  static constexpr ClosureFacts facts{"di-felice", "Di Felice (1994)"};

  // F = drag / (3 pi mu d U) [-]; f_s in [0, 1), Re = rho U d / mu >= 0.
  static double force(double f_s, double re) {
    const double root = 0.63 * std::sqrt(re) + 4.8;  // sqrt(C_D Re)
    const double decades = re > 0.0 ? 1.5 - std::log10(re) : 0.0;
    const double dip = re > 0.0 ? 0.65 * std::exp(-0.5 * decades * decades) : 0.0;
    return root * root / 24.0 * std::pow(1.0 - f_s, dip - 3.7);
  }
};

}  // namespace granvof::closures
