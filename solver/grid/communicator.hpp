// Exchange of ghost values and global reductions: the one place where a distributed grid differs.
//
// A layout names the communicator to the processes that hold the rest of its box. Without one the box is
// whole: exchange() then only joins the ends of periodic directions. Loops and operators know nothing of it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/grid/layout.hpp"

namespace granvof {

class Communicator {
 public:
  // What an end of a slab sends to its neighbour there, and where that one's goes; as many bytes each.
  struct End {
    std::span<const std::byte> out;
    std::span<std::byte> in;
  };

  // What this process has sent, and how often it took part in what all do together (sums, gatherings).
  struct Traffic {
    long messages = 0, bytes = 0, meetings = 0;
  };

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  Communicator(Communicator&&) = delete;
  Communicator& operator=(Communicator&&) = delete;
  virtual ~Communicator() = default;

  // Number of slabs that one box is cut into, a process each, and which is this one's, lowest first. 1: every
  // process has a box of its own, and they share sums and largest values alone.
  virtual int size() const { return 1; }
  virtual int rank() const { return 0; }

  // Every value becomes the sum, or the largest, of all processes' values at its place, to the bit the same
  // in each of them. No value is NaN in max().
  virtual void sum(std::span<double> values) const = 0;
  virtual void max(std::span<double> values) const = 0;

  // Between slabs only. Trades with the processes below and above; an empty end has none, the lowest and the
  // highest process are neighbours where neither's is.
  virtual void trade(const End& below, const End& above) const;
  // What every process gives, one after another, sizes[rank] bytes each: in all of them, or in the lowest
  // alone (`all` of the others may be empty).
  virtual void gather(std::span<const std::byte> mine, std::span<const std::size_t> sizes,
                      std::span<std::byte> all, bool everywhere) const;
  // The lowest process's bytes, in all.
  virtual void broadcast(std::span<std::byte> bytes) const;

  // Ends all processes at once, since this one cannot go on with the others. Does nothing where they do not
  // depend on each other.
  virtual void abort(int /*code*/) const {}
  virtual Traffic traffic() const { return {}; }

  // Fills the ghost layers that belong to a neighbour: another process, or the opposite end of a periodic
  // direction.
  template <typename T>
  void exchange(const Layout& layout, T* values) const;

 private:
  mutable std::array<std::vector<std::byte>, 4> buffers_;  // of the ends of a slab, out and in
};

// Refreshes the ghosts of a layout that is not shared: the ends of its periodic directions.
template <typename T>
void join_ends(const Layout& layout, T* values);

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
