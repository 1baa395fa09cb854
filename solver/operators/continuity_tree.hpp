// The same as continuity_closure.hpp where columns do not reach from the floor to the top: with obstacles, or
// with sides other than the top through which something flows.
#pragma once

#include <optional>
#include <vector>

#include "solver/grid/boundary.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/continuity_parts.hpp"

namespace granvof {

// A tree over the open faces of the tank: every cell hands what it gains to the next on its way out through
// the nearest side that passes the fluid; without one, to the first cell of its part of the tank, where the
// sum is zero but for rounding. Of a tank that is cut among processes every slab has trees of its own, and
// what their parts gain is handed on first (continuity_parts.hpp).
class ContinuityTree {
 public:
  explicit ContinuityTree(const Grid& grid) : grid_(grid), gain_(grid) {}

  // After the gate has moved, too. All processes at once, as close().
  void grow(const Aperture& aperture);
  // Adds to flux_c [m/s] what closes continuity, as close_continuity().
  void close(const Boundary& boundary, const FaceField& flux_s, FaceField& flux_c);
  // Of a cell: the number of its part of the tank where that has no side that passes the fluid, the same in
  // all processes; negative elsewhere and in obstacles. How many such parts there are.
  int sealed_part_of(std::ptrdiff_t cell) const {
    const int part = part_of_[static_cast<std::size_t>(cell)];
    return part < 0 ? part : sealed_of_[static_cast<std::size_t>(part)];
  }
  int sealed_parts() const { return sealed_parts_; }

 private:
  struct Step {
    std::ptrdiff_t cell, next;  // next: -1 where the face is on a side
    int direction;              // of the face
    std::ptrdiff_t face;
    double sign;  // of a flux that leaves the cell through it
  };

  const Grid& grid_;
  std::vector<Step> steps_;               // from the roots outwards
  Field gain_;                            // -div of both fluxes [1/s]
  std::optional<ContinuityParts> parts_;  // of a tank that is cut
  std::vector<int> part_of_;              // of this slab's parts, by the index of a cell
  std::vector<int> sealed_of_;            // number among the sealed ones, of every part
  int sealed_parts_ = 0;
};

}  // namespace granvof
