// The uniform staggered Cartesian grid of a run and its local box.
//
// Scalars live at cell centres; velocity component d lives on the faces normal to d. Face (i, j, k) of
// direction d is the LOWER face of cell (i, j, k), so that all fields share one layout and a neighbour is one
// stride away.
#pragma once

#include "solver/grid/layout.hpp"
#include "solver/grid/obstacles.hpp"
#include "solver/grid/reduce.hpp"
#include "solver/grid/sides/side_rule.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

inline constexpr int ghost_layers = 2;  // the widest stencil (limited upwind, CICSAM) looks two cells upwind

inline constexpr int vertical = 1;  // the direction across the floor

struct Grid {
  int dim = 2;                    // computed directions; a 2D grid stores one layer in z and never touches it
  Layout cells;                   // layout shared by cell and face fields
  Vec3 h{};                       // spacing [m]
  double cell_volume = 0.0;       // [m3]; in 2D times the tank's depth
  std::array<SideRule, 6> sides;  // of this box, indexed by SideIndex; a seam is joined to what is beyond
  std::array<SideRule, 6> tank_sides;  // of the whole tank
  Obstacles obstacles;

  // `communicator` to those who hold the rest of the tank must outlive this; none: it is whole. check_cut()
  // says whether that many processes can share it.
  explicit Grid(const Scene& scene, const Communicator* communicator = nullptr);

  // Every column of cells is open from the floor to the top, and nothing flows through other sides than that.
  bool has_whole_columns() const;

  std::ptrdiff_t stride(int d) const { return cells.stride[d]; }
  Range all_cells() const { return Range::all(cells); }
  // Cells and `layers` ghosts in every computed direction.
  Range cells_and_ghosts(int layers) const;
  const SideRule& side(int d, bool upper) const { return sides[2 * d + (upper ? 1 : 0)]; }
  const SideRule& tank_side(int d, bool upper) const { return tank_sides[2 * d + (upper ? 1 : 0)]; }
  // This box reaches to that side of the tank.
  bool has_side(int d, bool upper) const { return !cells.seam(d, upper); }
  // Grains meet bumps on a side of the tank.
  bool has_bumps() const;
  // No side of the tank passes the fluid: its volume has nowhere to go, and P_c no level of its own.
  bool sealed() const;

  // Faces of direction d that are on no side: where the solid velocity is unknown.
  Range inner_faces(int d) const;
  // The same for the fluid, the faces of sides that pass it included.
  Range fluid_faces(int d) const;
  // All faces that either phase may pass: those of the fluid, and of sides where its velocity is given.
  Range flux_faces(int d) const;
  // Faces of one side of the tank across direction d; none where another process has them.
  Range side_faces(int d, bool upper) const;
  // The cells along it.
  Range side_cells(int d, bool upper) const;
  // visit(d, upper) for every side of the tank through which something flows, in all processes, so that they
  // can add up what each of them has of it (side_faces()).
  template <typename Visit>
  void for_each_open_side(Visit&& visit) const {
    for (int d = 0; d < dim; ++d)
      for (const bool upper : {false, true})
        if (tank_side(d, upper).is_open()) visit(d, upper);
  }
  // The same for those that pass the fluid at a pressure.
  template <typename Visit>
  void for_each_passing_side(Visit&& visit) const {
    for_each_open_side([&](int d, bool upper) {
      if (tank_side(d, upper).passes_fluid) visit(d, upper);
    });
  }
  // Faces of direction d as a box of their own, in the memory of the cells' layout: one more than cells
  // across a side.
  Layout face_layout(int d) const;
  // Edges of the plane (d, e), both box boundaries included.
  Range edges(int d, int e) const { return edges(all_cells(), d, e); }
  // The same of a part of the cells.
  static Range edges(Range cells, int d, int e);
  // Every face of direction d, both box boundaries included.
  Range all_faces(int d) const;
};

}  // namespace granvof
