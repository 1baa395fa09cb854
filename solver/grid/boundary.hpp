// Ghost values and closed faces at the sides of the tank.
#pragma once

#include "solver/grid/communicator.hpp"
#include "solver/grid/field.hpp"

namespace granvof {

enum class Phase { fluid, solid };

class Boundary {
 public:
  Boundary(const Grid& grid, const Scene& scene, const Communicator& communicator)
      : grid_(grid), sides_(scene.sides), communicator_(communicator) {}

  // Zero normal gradient on closed sides; at an open top the ghost is `beyond_open_top` where that is given.
  void fill_scalar(Field& f) const;
  void fill_scalar(Field& f, double beyond_open_top) const;
  // Zero normal gradient on closed sides; P_c = 0 on the open top itself (ghost = minus the cell).
  void fill_pressure(Field& p) const;
  // Normal velocity zero on closed sides; tangential ghosts by the wall's kind (no-slip: the wall's velocity
  // on the face; slip and Coulomb: no gradient, Coulomb stress is the friction operator's); open top: no
  // gradient.
  void fill_velocity(FaceField& u, Phase phase) const;

  // Refreshes only the ghosts of periodic directions.
  void exchange(Field& f) const { communicator_.exchange(grid_.cells, f.data()); }
  void exchange(double* values) const { communicator_.exchange(grid_.cells, values); }

  const Side& side(int direction, int upper) const { return sides_[2 * direction + upper]; }

 private:
  template <typename Rule>
  void fill_cells(Field& f, Rule&& rule) const;

  const Grid& grid_;
  std::array<Side, 6> sides_;
  const Communicator& communicator_;
};

}  // namespace granvof
