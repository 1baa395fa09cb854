// The whole box of a layout that is cut among processes: for what is done in one of them (output), or in all
// alike since it costs little (the coarse levels of multigrid).
#pragma once

#include <cstddef>
#include <vector>

#include "solver/grid/communicator.hpp"

namespace granvof {

class WholeBox {
 public:
  enum class Values { box, box_and_ghosts };

  // `part` is cut along one direction at most and names its communicator; `whole` is the layout of its whole
  // box in one piece. With ghosts they have as many. All processes at once.
  WholeBox(const Layout& part, const Layout& whole, Values values);

  // The values of all processes' parts: in all of them, or in the lowest, where the others' `whole` may be
  // null.
  template <typename T>
  void collect(const T* part, T* whole, bool everywhere) const;
  // This process's part of what it has whole; with ghosts all of its ghosts too.
  template <typename T>
  void take(const T* whole, T* part) const;

 private:
  // Layers of a process along the cut, places in the whole box.
  struct Layers {
    int begin = 0, end = 0;
  };
  // visit(index in layer 0 of the part, in layer 0 of the whole, number of a value) for the values of a
  // layer.
  template <typename Visit>
  void for_each_value_of_a_layer(Visit&& visit) const;
  std::size_t values_of_a_layer() const;

  Layout part_, whole_;
  bool ghosts_;
  int cut_ = 0;
  std::vector<Layers> layers_;  // of every process
  mutable std::vector<std::byte> mine_, all_;
};

}  // namespace granvof
