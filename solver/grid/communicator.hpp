// Exchange of ghost values and global reductions: the one place where a distributed grid differs.
//
// A layout names the communicator to the processes that hold the rest of its box. Without one the box is
// whole: exchange() then only joins the ends of periodic directions. Loops and operators know nothing of it.
#pragma once

#include <span>

#include "solver/grid/layout.hpp"

namespace granvof {

class Communicator {
 public:
  virtual ~Communicator() = default;
  // Fills the ghost layers that belong to a neighbour: another process, or the opposite end of a periodic
  // direction.
  virtual void exchange(const Layout& layout, double* values) const = 0;
  virtual void exchange(const Layout& layout, float* values) const = 0;
  // Every value becomes the sum, or the largest, of all processes' values at its place, to the bit the same
  // in each of them. No value is NaN in max().
  virtual void sum(std::span<double> values) const = 0;
  virtual void max(std::span<double> values) const = 0;
};

// Joins the ends of periodic directions that lie whole in this process.
void join_ends(const Layout& layout, double* values);
void join_ends(const Layout& layout, float* values);

inline bool any_periodic(const Layout& l) {
  return l.periodic[0] || l.periodic[1] || l.periodic[2];
}

// Refreshes the ghosts of `values` that a side of the tank does not give.
template <typename T>
inline void exchange(const Layout& l, T* values) {
  if (l.communicator != nullptr)
    l.communicator->exchange(l, values);
  else if (any_periodic(l))
    join_ends(l, values);
}

}  // namespace granvof
