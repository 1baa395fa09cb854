// Drag coefficient beta_c on faces, eqs (8), (9), from the slip of the old level.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/mixture.hpp"

namespace granvof {

class InterphaseDrag {
 public:
  InterphaseDrag(const Grid& grid, const Scene& scene)
      : grid_(grid), scene_(scene), slip_(grid), beta_(grid) {}

  // One ghost layer of both velocities and of alpha must be filled; f_s on faces comes with the inertia.
  // A face at a periodic end has its copy at the other.
  void update(const Boundary& boundary, const FaceField& u_s, const FaceField& u_c, const Field& alpha,
              const FaceInertia& inertia);

  const FaceField& beta() const { return beta_; }  // [kg/m3 s], zero where a face holds no grains

 private:
  const Grid& grid_;
  const Scene& scene_;
  FaceField slip_;  // u_c - u_s, component by component [m/s]
  FaceField beta_;
};

}  // namespace granvof
