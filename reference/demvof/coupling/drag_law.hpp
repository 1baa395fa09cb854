// Drag of one bead, eqs (8) and (9), written independently of the continuum solver's closures.
//
// beta / f_s of (8) times the bead's volume gives the coefficient of (u_c - u_s) on one bead [kg/s]: finite
// as f_s -> 0. The printed branches do not meet at f_c = 0.8; they are blended linearly over f_c in [0.78,
// 0.82], as the continuum does, so that both programs mean the same law.
#pragma once

namespace demvof {

struct PhaseProperties {
  double density = 0.0;    // [kg/m3]
  double viscosity = 0.0;  // [Pa s]
};

// Of one grain: a coarse-grained bead has that of all the grains it stands for.

// Coefficient [kg/s] in one fluid. f_s in [0, 1), slip = |u_c - u_s| >= 0 [m/s], diameter [m].
double bead_drag(double f_s, double slip, const PhaseProperties& fluid, double diameter);

// The share alpha of liquid and 1 - alpha of gas.
double bead_drag(double f_s, double alpha, double slip, const PhaseProperties& gas,
                 const PhaseProperties& liquid, double diameter);

}  // namespace demvof
