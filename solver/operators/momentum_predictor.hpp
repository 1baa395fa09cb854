// Explicit part of both momentum balances, (5) and (6): convection, gravity, and what only the fluid feels
// explicitly, its viscosity and its old pressure gradient. The solid's enters the implicit step
// (solid_momentum.hpp), or the bed would hang on its own viscosity.
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/operators/aperture.hpp"
#include "solver/operators/surface_weight.hpp"
#include "solver/operators/viscosity.hpp"

namespace granvof {

// Accelerations beside gravity, on the faces of each direction [m/s2]: the sources of a manufactured
// solution.
struct BodyAcceleration {
  FaceField solid, fluid;
};

class MomentumPredictor {
 public:
  MomentumPredictor(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // From the old state, ghosts filled; inertia and viscosity of its level. `extra` may be null.
  void update(double dt, const State& now, const FaceInertia& inertia, const FluidViscosity& viscosity,
              const Aperture& aperture, const BodyAcceleration* extra);

  // [m/s], zero on closed faces; that of the solid stays as it is where there are no grains at all.
  const FaceField& solid() const { return solid_; }
  const FaceField& fluid() const { return fluid_; }
  // For the implicit step of the viscosity, which adds what it does to the fluid.
  FaceField& fluid() { return fluid_; }
  // Convective part of the fluid's acceleration [m/s2].
  const FaceField& convective_fluid() const { return convective_; }
  // Power that the upwinding of both momenta takes, and power of the explicit viscous force [W].
  double upwind_power() const { return upwind_power_; }
  double viscous_power() const { return viscous_power_; }
  const SurfaceWeight& surface_weight() const { return surface_weight_; }

 private:
  void convect_fluid(double dt, const State& now, const FaceInertia& inertia, int d);
  void convect_solid(double dt, const State& now, const FaceInertia& inertia, int d);
  void set_fluid_mass(const State& now);
  void weigh_surface(double dt, const FaceInertia& inertia, const Aperture& aperture, int d);
  void add(double dt, const Aperture& aperture, const FaceField& extra, int d, const Range& faces,
           FaceField& predicted) const;

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  bool limited_;
  FaceField solid_, fluid_, convective_;
  SurfaceWeight surface_weight_;
  Field fluid_mass_;  // f_c rho_c of cells [kg/m3], where momentum goes with it
  double upwind_power_ = 0.0, viscous_power_ = 0.0;
};

}  // namespace granvof
