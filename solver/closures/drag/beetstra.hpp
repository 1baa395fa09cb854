// Drag on a grain of a suspension or a bed: R. Beetstra, M. A. van der Hoef, J. A. M. Kuipers, AIChE J. 53
// (2007) 489, with F(f_s, 0) of van der Hoef et al., J. Fluid Mech. 528 (2005) 233.
//
// From lattice-Boltzmann simulations of beds at random, f_s 0.1 to 0.6, Re up to 1000. At Re -> 0 Carman's
// 10 f_s / f_c^2 in packed beds and Stokes for the lone grain.
#pragma once

#include <cmath>

#include "solver/closures/drag/of_force.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

struct DragBeetstra : DragOfForce<DragBeetstra> {
  static constexpr ClosureFacts facts{"beetstra", "Beetstra et al. (2007)"};

  // F = drag / (3 pi mu d U) [-], the mean pressure gradient's part not in it; f_s in [0, 1),
  // Re = rho U d / mu >= 0, U = f_c |u_c - u_s|.
  static double force(double f_s, double re) {
    const double f_c = 1.0 - f_s;
    const double slow = 10.0 * f_s / (f_c * f_c) + f_c * f_c * (1.0 + 1.5 * std::sqrt(f_s));
    // (... + 8.4 Re^-0.343) / (1 + 10^(3 f_s) Re^-a) with a = (1 + 4 f_s) / 2, multiplied by Re^a:
    // finite at 0
    const double a = 0.5 * (1.0 + 4.0 * f_s), power = std::pow(re, a);
    const double fast = power * (1.0 / f_c + 3.0 * f_s * f_c) + 8.4 * std::pow(re, a - 0.343);
    return slow + 0.413 / (24.0 * f_c * f_c) * re * fast / (power + std::pow(10.0, 3.0 * f_s));
  }
};

}  // namespace granvof::closures
