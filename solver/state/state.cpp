#include "solver/state/state.hpp"

namespace granvof {

State::State(const Grid& grid) {
  for (const CellQuantity& q : cell_quantities) this->*q.field = Field(grid);
  for (const FaceQuantity& q : face_quantities) this->*q.field = FaceField(grid);
}

void State::fill_ghosts(const Boundary& boundary) {
  for (const CellQuantity& q : cell_quantities) q.fill(boundary, this->*q.field);
  for (const FaceQuantity& q : face_quantities) boundary.fill_velocity(this->*q.field, q.phase);
}

}  // namespace granvof
