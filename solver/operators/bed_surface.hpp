// Partly filled cells at the surface of a bed: grains packed in a part of the cell, at rest on what lies
// below.
//
// The law (13) knows no contact below f_s,min, so the cells that hold the bed's surface carry neither weight
// nor friction: their grains hang in the fluid, the drag hands their weight to P_c, and the surface runs down
// the slope as a density current (a heap of 12 degrees creeps at 4 cm/s for ever). Yet such a cell stands for
// grains at f_s,min that fill the share f_s / f_s,min of its height, and those bear their own submerged
// weight by contact. On a staggered grid a face holds half the grains of either cell, so that
//   P_s = 1/2 f_s |rho_s - rho_c| g h      (half the cell's weight per area)
// balances the weight of both halves exactly when the cell rests on a packed one and nothing rests on it: at
// the face above 0 - P_s takes one half, at the face below P_s - P_s,below the other. It is taken as a third
// claimant beside kinetic and dense-flow pressure: P_s^EF = max(P_s^D, P_s^W) - P_s^K in (14); friction (17)
// follows. What lies in the cell above is not at rest on this one until this one is packed: only what the
// cell holds beyond it bears anything, so that a suspension of one fraction bears nothing.
//
// Such a cell has a free face, above its grains (below those that press upwards): their surface lies inside
// the cell, and the velocity of that face is not theirs but that of the few grains which fall on them or hang
// over the edge. It strains no grains: left in S of (17) it outruns the creep of the bed by orders, the law
// yields to it, and the surface runs. So neither the normal strain of the cell nor the tilt of an edge by a
// free face counts in S, and the stress of such an edge does no work on that face (friction_law.cpp;
// Rheology::free_side says which cells). Nor does the fluid drag those at rest along with it: with the drag
// of all, the face under a thin cloud falls for ever, carries nothing, and stirs the water above a heap at
// rest at 7 mm/s (interphase_drag.hpp). The vertical normal stress of contacts acts on the face only while
// nothing falls on it: held then, grains that settle wait above the cell until it yields, sooner in one
// column than in the next (0.06 in f_s after four minutes).
//
// Own derivation; it vanishes with the grid, like the cells it is about.
// Equations: docs/theory/contact.md.
#pragma once

#include <algorithm>

#include "solver/grid/field.hpp"

namespace granvof {

// All of the old level, in interior cells, 0 but at the surface of a bed.
struct PartCells {
  // P_s^W [Pa]. With f = min(f_s, f_s,min):
  //   P_s^W = 1/2 |rho_s - rho_c| g h r (f - f_s of the cell above), at most P_s of the cell below.
  // It does not answer to what the step makes of f_s: faces hold the grains of the old level, and a cell that
  // fills would throw them up.
  // The support r from below is 1 on a closed floor, on a packed cell, and on a part-cell that is supported
  // and whose free face is held; else 0: grains fall into a cell that has room for them. The bound by P_s
  // takes the weight off a bed in free fall.
  Field resting;
  // Solid fraction whose weight that is, > 0 for heavy grains, < 0 for those lighter than the fluid, which
  // press upwards: above and below change places.
  Field at_rest;
  // 1 where nothing falls on the free face: the grains below hold it. 0 where it is free.
  Field held;

  explicit PartCells(const Grid& grid) : resting(grid), at_rest(grid), held(grid), support_(grid) {}
  // One ghost layer of f_s and P_s must be filled.
  void update(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha, const Field& p_s);

 private:
  Field support_;
};

// Half the weight of a cell's grains in the fluid, per area [Pa], < 0 where they press upwards: what lies
// between the middle of the cell and its floor or lid. Ghosts are filled where f_s and alpha have theirs.
void set_half_weights(const Grid& grid, const Scene& scene, const Field& f_s, const Field& alpha,
                      Field& weight);

// What a wall bears beyond the contact pressure in the middle of the cell beside it [Pa]; `weight`: half the
// cell's weight towards the wall. At most the pressure again.
inline double borne_by_wall(double pressure, double weight) {
  return std::min(std::max(weight, 0.0), pressure);
}

// Contact pressure on floor and lid [Pa]: adds to the ghosts of `pressure` (mirrored on entry) twice what the
// wall bears beyond the cell, so that the mean over both sides is the pressure at the wall itself: a layer of
// one cell presses on the floor with its whole weight. On obstacles the same: friction_law.cpp.
void extend_to_walls(const Grid& grid, const Field& half_weight, Field& pressure);

}  // namespace granvof
