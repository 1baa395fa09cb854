// friction_direct.hpp for a tank that is cut among processes: every one has the whole bed, factorises all of
// it and does the same with it, as with the coarse levels of multigrid.
//
// A thin bed is few unknowns. Shared iterations need an exchange for every sweep of every level, and a raft
// 100 to 200 of them.
#pragma once

#include <vector>

#include "solver/operators/friction_direct.hpp"

namespace granvof {

class FrictionDirectOfSlabs {
 public:
  // `grid`: cut along x.
  FrictionDirectOfSlabs(const Grid& grid, const Scene& scene);

  // As FrictionDirect, with arrays of the slab's layout and a box whose rows along y are those of all; all
  // processes at once, with one answer.
  bool factorise(const Range& box, const FrictionForm& form);
  void apply(const linear::ConstComponents& r, const linear::Components& z);

 private:
  // Columns of faces that a process has: with the side of the tank, where it is there.
  struct Columns {
    int first = 0, count = 0;
  };
  bool is_thin(const Range& box, const FrictionForm& form) const;
  // The rows of the box of every array, of all processes, in whole_values_.
  void collect(const std::vector<const double*>& parts);

  const Grid& grid_;
  Grid whole_;
  FrictionDirect direct_;
  std::vector<Columns> columns_;     // of every process
  Range box_{{0, 0, 0}, {0, 0, 0}};  // of the whole bed
  std::vector<Field> whole_values_, correction_;
  std::vector<double> mine_, all_;
};

}  // namespace granvof
