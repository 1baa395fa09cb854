// Ghost values and given faces at the sides of the tank, and the walls inside it.
#pragma once

#include "solver/grid/communicator.hpp"
#include "solver/grid/field.hpp"
#include "solver/grid/inner_walls.hpp"

namespace granvof {

class Boundary {
 public:
  explicit Boundary(const Grid& grid);

  // Zero normal gradient; `beyond` where given on sides that pass the fluid.
  void fill_scalar(Field& f) const;
  void fill_scalar(Field& f, double beyond) const;
  // What the sides have beyond them, else zero normal gradient.
  void fill_solid_fraction(Field& f_s) const;
  void fill_liquid_share(Field& alpha) const;
  // The same, and what flows back by the fluid's flux through the side, where two fluids lie beyond it.
  void fill_liquid_share(Field& alpha, const FaceField& flux_c) const;
  // Zero normal gradient on sides where the fluid's velocity is given; on those that pass it the side's own
  // pressure, on the side itself (ghost = twice that minus the cell), or an increment of zero.
  void fill_pressure(Field& p) const;
  void fill_pressure_increment(Field& p) const;
  // The pressure on the faces of a side, at the index of the first cell beyond it; null where all are zero.
  const double* side_pressure() const { return side_pressure_.empty() ? nullptr : side_pressure_.data(); }
  // Faces of a side: the given velocity (zero on closed ones), or that of grains that leave. Ghosts by the
  // side's tangent; no normal gradient where a phase passes.
  void fill_velocity(FaceField& u, Phase phase) const;

  // Refreshes only the ghosts that no side of the tank gives.
  void exchange(Field& f) const { exchange(f.data()); }
  void exchange(double* values) const { granvof::exchange(grid_.cells, values); }

  const SideRule& side(int direction, bool upper) const { return grid_.side(direction, upper); }
  // What ghosts are to the sides, to whoever looks across obstacles or the gate.
  const InnerWalls& walls() const { return walls_; }
  // The gate has moved, see InnerWalls.
  void shut_gate(int face, int open_rows) { walls_.shut_gate(face, open_rows); }

 private:
  template <typename Rule>
  void fill_cells(Field& f, Rule&& rule) const;
  // value(place on the side [m]) on every face of a side, ghost rows along it included, in a field that is
  // allocated if it was not.
  template <typename Value>
  void set_beyond(Field& f, int d, bool upper, Value&& value) const;
  void fill_sides(FaceField& u, int d, Phase phase) const;
  void fill_beyond(FaceField& u, int d, bool upper, Phase phase) const;

  const Grid& grid_;
  // Both at the index of the first cell beyond a side, allocated if a side has them.
  Field side_pressure_, flows_back_;
  InnerWalls walls_;
};

}  // namespace granvof
