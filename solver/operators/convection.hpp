// Convective acceleration -(u . grad) u of a staggered velocity, first-order upwind.
//
// The advective form is used for both phases: it needs no division by a phase fraction that may vanish and no
// mass flux that a 1:1000 interface makes inconsistent.
#pragma once

#include "solver/grid/field.hpp"
#include "solver/grid/inner_walls.hpp"

namespace granvof {

// Writes the acceleration [m/s2] of component d on `faces`; two ghost layers of u must be filled, and walls
// inside are to it what sides of the tank are. With
// `limited` the one-sided differences are replaced by van Leer limited ones (second order where u is smooth).
//
// Returns what the scheme takes beside central differences: the sum over the faces of -m u_d (a - a_central)
// [W/m3], m the `mass` of component d [kg/m3]. Of one-sided differences it is that of a viscosity |u_e| h /
// 2, m |u_e| h / 2 times the squared gradient of u_d along every e.
double convective_acceleration(const Field& mass, const Grid& grid, const InnerWalls& walls,
                               const FaceField& u, int d, const Range& faces, bool limited,
                               Field& acceleration);

// Limited on faces that carry more than `least` of `mass` (of component d), one-sided elsewhere. For a gas
// over a liquid: a limiter looks at velocities alone and does not see the interface, and what it hands to a
// gas a thousand times lighter becomes jets (2 m/s over a liquid at 0.5 m/s) that bound the step. Where the
// liquid's own faces beside the gas were one-sided too, a dam break lost a third of its accuracy.
double convective_acceleration_limited_in(const Field& mass, double least, const Grid& grid,
                                          const InnerWalls& walls, const FaceField& u, int d,
                                          const Range& faces, Field& acceleration);

// For faces whose `fraction` is too small to bound the step: their acceleration, times the share of dt in
// which their own velocity crosses half a cell. An explicit step over more than a cell grows without bound,
// and what a handful of grains does in the gas (1e-6 of a cell, at kilometres a second) must not end a run.
// With this share no new extremum appears.
void bound_convection(const Grid& grid, const FaceField& u, int d, const Range& faces, double dt,
                      const Field& fraction, double least, Field& acceleration);

}  // namespace granvof
