// Which faces are open: 1 inside, 0 on closed sides and where the gate still stands.
#pragma once

#include <optional>

#include "solver/grid/field.hpp"

namespace granvof {

class Aperture {
 public:
  Aperture(const Grid& grid, const Scene& scene);

  // Moves the gate: it is closed up to t = 0 and its lower edge is at speed * t after. Returns true if it
  // moved.
  bool update(double time);
  // The gate's faces, as InnerWalls::shut_gate() takes them.
  bool has_gate() const { return gate_.has_value(); }
  int gate_face() const { return gate_face_; }
  int open_rows() const { return open_rows_; }

  // 1 or 0 on every face of direction d; the faces of an open top are 1 for the fluid, and 0 for the solid
  // because inner_faces() leaves them out.
  const Field& operator[](int d) const { return open_[d]; }

 private:
  const Grid& grid_;
  std::optional<Gate> gate_;
  int gate_face_ = 0;   // index in x of the faces the gate blocks, in the whole tank
  int open_rows_ = -1;  // rows of cells already free
  FaceField open_;
};

}  // namespace granvof
