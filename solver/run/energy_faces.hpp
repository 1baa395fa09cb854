// The energy budget's sums over faces: what moves, what works on it, and what passes the sides.
#pragma once

#include "solver/run/energy_budget.hpp"

namespace granvof {

// Sums over faces [J]. u, v: velocity of solid and fluid; m: inertia of the old level; 0 and 1: levels.
// Faces of sides that the fluid passes count half: half a cell of fluid moves with them.
struct FaceWork {
  double moved = 0.0;      // 1/2 (m1 - m0) u1^2: mass that crossed faces
  double kinetic = 0.0;    // 1/2 m1 u1^2
  double step = 0.0;       // 1/2 m |u1 - u0|^2
  double convected = 0.0;  // work of the convective acceleration
  double viscous = 0.0;    // of the viscous forces, implicit ones included
  double slip = 0.0;       // beta |u - v|^2 dt
  // What the fluxes add to the mean of a face, against gravity and fluid pressure.
  double solid_transport = 0.0, fluid_transport = 0.0;
  // Through the sides, outwards.
  double potential_out = 0.0, kinetic_out = 0.0, granular_out = 0.0;
  double side_pressure = 0.0;  // by the pressure on the sides, given
  double driving = 0.0;        // of gravity, along periodic directions, which have no potential
};

FaceWork work_on_faces(const Grid& grid, const Scene& scene, const double* side_pressure, double dt,
                       const State& now, const State& next, const StepTrace& trace);

}  // namespace granvof
