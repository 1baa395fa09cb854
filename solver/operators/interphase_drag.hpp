// Drag coefficient beta_c on faces, by the law of the scene, from the slip of the old level.
//
// beta = 18 mu f_s f_c F / d^2: number of grains and share of the fluid are the face's means, but on
// the free face of a part-cell (Rheology::free_side) that grains fall on: those at rest below are held by
// contacts, and the force between fluid and grains is the weight of what falls. With the second-order fluxes
// the hindrance F is taken at the fraction that the fluid brings along, upwind along its slip: that of the
// cell the grains move into. A suspension's own flux f_s u_s(f_s) is then monotone: it rises with what is
// above and falls with what is below. With F of the mean too, the face at a front lets grains through that
// the packing behind it holds up: f_s rises behind the front by 1 to 15 %, and by what the solvers leave
// differently in each column. The paper's first-order scheme keeps the mean.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/solid_fraction_flux.hpp"
#include "solver/state/state.hpp"

namespace granvof {

class InterphaseDrag {
 public:
  InterphaseDrag(const Grid& grid, const Scene& scene)
      : grid_(grid),
        scene_(scene),
        fraction_(scene.numerics.transport_scheme),
        slip_(grid),
        hindering_(grid),
        beta_(grid),
        of_cells_(grid) {}

  // One ghost layer of both velocities and of alpha and two of f_s must be filled; f_s on faces comes with
  // the inertia, part-cells with the rheology. A face at a periodic end has its copy at the other.
  void update(const Boundary& boundary, const State& now, const FaceInertia& inertia,
              const Rheology& rheology);
  // The same without any grains.
  void clear();

  // At cell centres: what agitated grains are dragged by. (A mean over faces depends on how many of them lie
  // across the gradient of f_s: four cells thick another one than in the plane.)
  const Field& beta_of_cells() const { return of_cells_; }  // [kg/m3 s], interior
  const FaceField& beta() const { return beta_; }           // [kg/m3 s], zero where a face holds no grains

 private:
  template <typename Law>
  void fill(Law law, const Boundary& boundary, const State& now, const FaceInertia& inertia,
            const Rheology& rheology);

  const Grid& grid_;
  const Scene& scene_;
  SolidFractionFlux fraction_;
  FaceField slip_;   // u_c - u_s, component by component [m/s]
  Field hindering_;  // f_s that F is taken at, on the faces of one direction [-]
  FaceField beta_;
  Field of_cells_;
};

}  // namespace granvof
