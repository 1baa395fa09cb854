// Drag on a grain of a suspension or a bed: S. Tenneti, R. Garg, S. Subramaniam, Int. J. Multiphase Flow 37
// (2011) 1072.
//
// From particle-resolved simulations of random arrays, f_s 0.1 to 0.5, Re 0.01 to 300. Their force holds the
// mean pressure gradient's part too, which (5), (6) carry as f_s grad P_c: f_c times their F is the drag.
// Equations: docs/theory/balances.md.
#pragma once

#include <cmath>

#include "solver/closures/drag/of_force.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

struct DragTenneti : DragOfForce<DragTenneti> {
  static constexpr ClosureFacts facts{"tenneti", "Tenneti et al. (2011)"};

  // F = drag / (3 pi mu d U) [-], the mean pressure gradient's part taken off; f_s in [0, 1),
  // Re = rho U d / mu >= 0, U = f_c |u_c - u_s|.
  static double force(double f_s, double re) {
    const double f_c = 1.0 - f_s, cube = f_c * f_c * f_c, f_s3 = f_s * f_s * f_s;
    const double lone = 1.0 + 0.15 * std::pow(re, 0.687);  // Schiller & Naumann
    const double slow = 5.81 * f_s / cube + 0.48 * std::cbrt(f_s) / (cube * f_c);
    const double fast = f_s3 * re * (0.95 + 0.61 * f_s3 / (f_c * f_c));
    return f_c * (lone / cube + slow + fast);
  }
};

}  // namespace granvof::closures
