// Implicit solid stress: Coulomb friction (17) and kinetic viscosity (16) of u_s in one symmetric system.
//
// friction_law.cpp has the viscosities, friction_walls.cpp those at walls, friction_operator.cpp the
// operator, friction_preconditioner.cpp what it is preconditioned and judged by, friction_power.cpp its work;
// the solve is in friction.cpp.
//
//   mass u_s - div(2 mu S + lambda (div u_s) I) = rhs,  mu = f_s mu_s^K + mu_friction,  lambda = f_s mu_s^K
// (f_s (zeta - 2/3 mu) of (16) equals f_s mu_s^K because zeta/mu = 5/3; where whole-stress friction bounds
// mu_s^K, zeta stays). The full tensor is kept implicit: with a contrast of 1e10 its cross terms cannot be
// lagged. CG with one multigrid cycle a component, or with the factorised matrix where the bed is thin
// (friction_direct.hpp); the wall stress of no-slip and Coulomb walls is part of the operator. Known problem:
// with the full S of (17) friction carries normal load: the base of a bed at rest shows P_s = 270 Pa for a
// weight of 409 Pa; sigma_yy = P_s - tau_yy is what balances the weight. Equations: docs/theory/contact.md,
// docs/theory/kinetic-theory.md.
#pragma once

#include <optional>
#include <vector>

#include "solver/linear/conjugate_gradient.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/box_of_grains.hpp"
#include "solver/operators/friction_direct.hpp"
#include "solver/operators/friction_direct_of_slabs.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/rheology.hpp"
#include "solver/operators/strain.hpp"
#include "solver/state/state.hpp"

namespace granvof {

// What is to be balanced on every face: mass u_s = rhs + the force of the solid stress.
struct SolidBalance {
  explicit SolidBalance(const Grid& grid) : mass(grid), rhs(grid) {}
  FaceField mass;  // m_s + beta_eff of solid_momentum.hpp [kg/m3 s]
  FaceField rhs;   // [Pa/m]
};

class Friction {
 public:
  Friction(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // Solves for u_s of `next` on the faces that hold grains (f_s >= least_solid_fraction, open); elsewhere it
  // keeps its value and acts as a known velocity. It holds the guess. Viscosities from the rheology and from
  // the strain of u_strain of `now`, whose ghosts must be filled.
  linear::Report solve(const SolidBalance& balance, const FaceInertia& inertia, const Aperture& aperture,
                       const Rheology& rheology, const State& now, State& next);

  // The same once more within a step: viscosities from the strain of u_strain of `next`, what the last solve
  // gave (ghosts filled), and Coulomb walls by its normal traction. The first solve takes P_s^E for it.
  linear::Report solve_again(const SolidBalance& balance, const FaceInertia& inertia,
                             const Aperture& aperture, const Rheology& rheology, State& next);

  bool has_coulomb_walls() const;
  // Whether grains slip on Coulomb walls (u_s) by other than what the viscosities of the last solve were
  // taken at (u_strain): those are the walls' limit over the old speed, and hold what begins to slide for
  // many steps.
  bool slips_otherwise(const State& next) const;

  // What the viscosities of the last solve, those of u_strain, miss at u_s of `next`. A bed that begins to
  // yield is held by those of its rest: its speed grows by the ratio of what drives to what holds in each
  // solve, and the longer the step, the later it flows.
  struct Missed {
    double share = 0.0;  // of what friction dissipates [-]
    double held = 0.0;   // power that it takes beyond what its law would, over cells [W]
  };
  Missed yields_otherwise(const Rheology& rheology, const State& next);

  // Power [W] of the stress of the last solve, at the velocity u_strain of `next` that it was solved
  // for;
  // `kinetic` [W/m3]: what the kinetic viscosity dissipates in each cell, an edge's dissipation shared by its
  // cells as their viscosity.
  struct Power {
    double on_grains = 0.0;   // its force times the velocity u_s, on the faces that hold grains
    double solved_for = 0.0;  // the same with u_strain
    double friction = 0.0;    // dissipated by enduring contacts, >= 0
    double kinetic = 0.0;     // dissipated by the kinetic viscosity, >= 0: the production of Theta
    double walls = 0.0;       // given by moving walls
    double sides = 0.0;       // given by what is beyond sides that grains pass, along their normals
  };
  Power power(const FaceField& mass, const State& next, Field& kinetic);

 private:
  void fit_box(const FaceInertia& inertia);
  // The strain of u that shears grains past each other, on the box; one ghost layer of u must be filled.
  void strain_of_contacts(const Rheology& rheology, const FaceField& u, StrainRate& strain);
  void free_faces_of_part_cells(const Rheology& rheology, const FaceField& u, StrainRate& strain);
  void set_viscosity(const Rheology& rheology, const FaceField& u_strain);
  // f_s mu_s^K that collisions shear by [Pa s], ghosts filled; in the box alone that of the last solve.
  const Field& shear_of_collisions(const Rheology& rheology) const {
    return bounded_.empty() ? rheology.kinetic_viscosity : bounded_;
  }
  const Field& shear_of_collisions() const { return bounded_.empty() ? lambda_ : bounded_; }
  linear::Report solve_by(const SolidBalance& balance, const FaceInertia& inertia, const Aperture& aperture,
                          const Rheology& rheology, const FaceField& u_strain, FaceField& u_s);
  bool holds_by_friction(int d, bool upper) const;
  template <typename Chosen, typename Visit>
  void for_each_wall(Chosen&& chosen, Visit&& visit) const;
  template <typename Visit>
  void for_each_coulomb_wall(Visit&& visit) const;
  void keep_normal_stress(const FaceField& u);
  void set_wall_friction(const Rheology& rheology, const FaceField& u_strain);
  void set_kinetic_edges(const Rheology& rheology);
  void slip_on_bumps(const Rheology& rheology);
  void mark_faces(const FaceInertia& inertia, const Aperture& aperture);
  void cut_edges_beside_empty_faces(const FaceInertia& inertia, const Rheology& rheology);
  void hold_to_walls(const FaceInertia& inertia, const Rheology& rheology, int d, int e);
  void set_own_diffusion(const FaceField& mass);
  void set_multigrids();
  bool factorise(const FaceField& mass);
  FrictionForm form(const FaceField& mass) const;
  void set_weights(const FaceField& mass);
  // Share of the slope of the vertical velocity that shears the grains on the edges of a plane, see
  // free_faces_of_part_cells(); nullptr for all of it.
  const double* tilting(int d, int e) const;
  // The scene has them: what they alone need was made.
  bool has_part_cells() const { return !mu_vertical_.empty(); }
  // Viscosity that a normal strain along d meets [Pa s].
  const double* normal_viscosity(int d) const;
  // y = mass u - div(stress of u) where marked, 0 elsewhere; one ghost layer of u must be filled.
  void apply(const FaceField& mass, const linear::Components& u, const linear::Components& y);
  // Tangential velocities beyond the walls: minus the inside, or mirrored about the wall's own velocity.
  void fill_wall_ghosts(const linear::Components& u, bool moving_walls) const;

  const Grid& grid_;
  const Scene& scene_;
  const Boundary& boundary_;
  double velocity_;                      // of the scene [m/s], see scales.hpp
  Range box_{{0, 0, 0}, {0, 0, 0}};      // cells the fields below are kept on; outside they hold no stress
  std::array<Layout, 3> faces_;          // of the box, by direction
  StrainRate strain_, strain_of_solve_;  // that of the viscosities; of what they gave
  Field mu_, lambda_;                    // at cell centres [Pa s]
  Field bounded_;                        // bounded_kinetic_viscosity() of cells [Pa s]; empty without
  std::array<Field, 3> mu_edge_;         // on edges [Pa s], by plane_index()
  std::array<Field, 3> shear_;           // shear stress on edges [Pa]
  std::array<Field, 3> kinetic_edge_;    // with bumpy or Coulomb walls, the kinetic part of mu_edge_ [Pa s]
  std::array<Field, 3> tilting_;         // with part-cells, on the edges of vertical planes [-]
  Field mu_vertical_;                    // with part-cells, of the vertical normal strain [Pa s]
  FaceField normal_stress_;              // of contacts, beside Coulomb walls [Pa]; empty without
  Field divergence_;
  FaceField marked_;  // 1 where u_s is unknown
  std::optional<linear::ConjugateGradient> solver_;
  std::vector<linear::Multigrid> multigrid_;  // one a component; none until a bed is not thin
  std::array<FaceField, 3> coefficient_;      // [component][direction] of the component's own diffusion
  FrictionDirect direct_;
  std::optional<FrictionDirectOfSlabs> direct_of_slabs_;  // where the tank is cut, in two dimensions
  FaceField component_mass_, weight_, residual_, correction_;
};

}  // namespace granvof
