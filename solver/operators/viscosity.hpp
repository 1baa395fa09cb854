// Explicit viscous acceleration of the continuous phase: the diffusion term of (5) with LES (10).
// Equations: docs/theory/balances.md.
#pragma once

#include "solver/grid/boundary.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/strain.hpp"
#include "solver/state/state.hpp"

namespace granvof {

class FluidViscosity {
 public:
  FluidViscosity(const Grid& grid, const Scene& scene)
      : grid_(grid), scene_(scene), strain_(grid), viscosity_(grid) {}

  // f_c (mu_c + mu_t) of every cell from the old level, mu_c that of a suspension with suspension_viscosity;
  // u_c, f_s, alpha with one ghost layer filled.
  void update(const Boundary& boundary, const State& now);

  // The largest of the cells, LES included [m2/s].
  double largest_kinematic() const { return largest_kinematic_; }
  // Whether the explicit term is stable over a step of dt.
  bool bears(double dt) const;

  // Adds (1 / (f_c rho_c)) div(f_c (mu_c + mu_t)(grad u + grad u^T)) [m/s2] to component d.
  void add_acceleration(const FaceField& u_c, const FaceInertia& inertia, int d, const Range& faces,
                        Field& acceleration) const;

  // Power [W] of that force on component d: of what `with` has beyond `without` [m/s2]. Half a cell moves
  // with a face of a side.
  double power_on(const FaceField& u_c, const FaceInertia& inertia, int d, const Field& without,
                  const Field& with) const;

  // f_c (mu_c + mu_t) of the cells [Pa s], ghosts filled.
  const Field& of_cells() const { return viscosity_; }

  // Takes the strain of a velocity whose ghosts are filled; the viscosity stays.
  void set_strain(const Boundary& boundary, const FaceField& u_c) {
    strain_.update(grid_, boundary.walls(), u_c);
  }

  // Power [W] of that stress at the velocity of the strain.
  struct Power {
    double dissipation = 0.0;  // int 2 f_c (mu_c + mu_t) S:S dV, LES included
    double walls = 0.0;        // given by moving walls
    double sides = 0.0;        // given on the sides through which something flows
  };
  Power power(const Boundary& boundary, const FaceField& u_c) const;

 private:
  double power_on_side(const FaceField& u_c, int d, bool upper) const;

  const Grid& grid_;
  const Scene& scene_;
  StrainRate strain_;
  Field viscosity_;  // f_c (mu_c + mu_t) [Pa s]
  double largest_kinematic_ = 0.0;
};

}  // namespace granvof
