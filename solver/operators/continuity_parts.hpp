// Volume that passes between the parts which a cut tank's slabs fall into, for continuity_tree.hpp.
//
// Every process closes continuity within its own slab, along trees of its own. A part of a slab, cells that
// open faces join, that no fluid leaves through a side has to hand what it gains to a neighbour's part: a
// tree over all parts, the same in every process, says to which. Processes meet once a step, for one number a
// part.
#pragma once

#include <vector>

#include "solver/grid/boundary.hpp"
#include "solver/operators/aperture.hpp"

namespace granvof {

class ContinuityParts {
 public:
  explicit ContinuityParts(const Grid& grid) : grid_(grid), label_(grid) {}

  // part_of[index]: number of the part of a cell of this slab, negative in obstacles; drains[part]: fluid
  // leaves it through a side of the tank. All processes at once.
  void join(const std::vector<int>& part_of, const std::vector<char>& drains, const Aperture& aperture);
  // Leaves every part that does not drain without gain in the sum over its cells, but for rounding: changes
  // the gains [1/s] beside one face a pair of parts, and flux_c [m/s] there.
  void even_out(Field& gain, FaceField& flux_c);
  // Of every part of this slab: the number of what no fluid leaves through a side of the tank, parts of all
  // slabs together, that it belongs to; negative where fluid does. How many of those there are.
  const std::vector<int>& sealed_of() const { return sealed_of_; }
  int sealed() const { return sealed_; }

 private:
  // A face on a seam between two parts of neighbours. Numbers of parts are those of the whole tank.
  struct Link {
    int lower = 0, upper = 0;
  };
  struct Place {
    std::size_t link = 0;
    std::ptrdiff_t cell = 0;  // of this process, beside the link
  };
  // What a part hands on, to the next on its way out.
  struct Step {
    int from = 0, to = 0;
    std::size_t link = 0;
    double sign = 1.0;  // of a flux that leaves `from` through the link
  };

  template <typename Visit>
  void for_each_link(bool upper, const Aperture& aperture, Visit&& visit) const;
  std::vector<Link> gather(const std::vector<Link>& mine, std::vector<std::size_t>& begins) const;
  void grow(const std::vector<Link>& links, const std::vector<double>& drains);

  const Grid& grid_;
  int cut_ = 0;                                     // direction
  int first_ = 0;                                   // number of this process's first part
  std::vector<std::vector<std::ptrdiff_t>> cells_;  // of each of its parts
  Field label_;                                     // number of every cell's part, of the seams' ghosts too
  std::vector<Place> above_, below_;  // beside links on this slab's lower seam, and on its upper one
  std::vector<Step> steps_;           // from the roots outwards
  std::vector<double> gain_, flux_;   // of every part, through every link
  std::vector<int> sealed_of_;
  int sealed_ = 0;
};

}  // namespace granvof
