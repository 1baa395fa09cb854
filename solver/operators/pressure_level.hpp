// Level of the fluid pressure where no open side gives it one.
// Equations: docs/theory/balances.md.
#pragma once

#include <vector>

#include "solver/operators/continuity_tree.hpp"

namespace granvof {

// In a part of the tank without a side that passes the fluid continuity (4) fixes P_c but for a constant, and
// what a solver leaves of it wanders, by tens of Pa in a step. The level of this program: the mean of P_c
// over the lid is zero, P_c taken from the uppermost cells to the lid, half a cell above, by the weight of
// the continuous phase in them. A pool at rest then has the pressure it has under an open top, where P_c = 0
// everywhere. With a periodic vertical "the lid" is where the ends are joined. What an obstacle or the gate
// shuts off has a lid of its own, over the highest of its cells.
class PressureLevel {
 public:
  // Of a tank that nothing parts; else find_parts() comes next.
  PressureLevel(const Grid& grid, const Scene& scene);

  // Obstacles or a gate may shut off parts that no side gives a level.
  bool may_be_parted() const;
  // After the gate has moved, too. All processes at once.
  void find_parts(const ContinuityTree& tree);
  // Adds a constant to p_c [Pa] in every part, interior cells only; what has an open side is left alone.
  void set(const Field& alpha, Field& p_c) const;

 private:
  struct Lid {
    Range row;
    double cells = 0.0;  // of the part in that row
  };
  void add_part(int number, int row);
  // 1 in cells of a part, else 0.
  auto belongs_to(int part) const {
    return [=, of = part_of_.empty() ? nullptr : part_of_.data()](std::ptrdiff_t c) {
      return of == nullptr || of[c] == part ? 1.0 : 0.0;
    };
  }

  const Grid& grid_;
  const Scene& scene_;
  std::vector<int> part_of_;  // of every cell by its index, negative where there is none; empty: one part
  std::vector<Lid> lids_;     // of every part
};

}  // namespace granvof
