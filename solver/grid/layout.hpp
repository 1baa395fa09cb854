// How a local box of values lies in memory: x fastest, with ghost layers around it.
//
// Grid cells, faces and the levels of multigrid all use this, so that one exchange serves them all.
//
// A box may be cut into slabs, one a process. A slab knows where it begins in the whole box; an end that is
// none of the whole box is a seam, and so is a periodic end: what lies beyond comes by exchange(). The values
// on a seam itself, such as faces, are those of the process above it; the process below has a copy in its
// ghosts, as it has of a periodic end's.
#pragma once

#include <array>
#include <cstddef>

namespace granvof {

class Communicator;

struct Layout {
  std::array<int, 3> n{1, 1, 1};                      // values of the box, ghosts not counted
  std::array<int, 3> ghost{0, 0, 0};                  // ghost layers on each side of a direction
  std::array<bool, 3> periodic{false, false, false};  // direction joined to itself, of the whole box
  std::array<std::ptrdiff_t, 3> stride{1, 1, 1};      // distance of neighbours in memory
  std::ptrdiff_t origin = 0;                          // index of (0, 0, 0)
  std::size_t size = 1;                               // allocated values, ghosts counted
  std::array<int, 3> first{0, 0, 0};                  // place of (0, 0, 0) in the whole box
  std::array<int, 3> whole{1, 1, 1};                  // values of the whole box
  const Communicator* communicator = nullptr;  // to those who hold the rest of the box; none: it is whole

  // A compact layout: `ghost` layers in every direction with more than one value or with periodic ends.
  static Layout make(std::array<int, 3> n, std::array<int, 3> ghost, std::array<bool, 3> periodic) {
    Layout l;
    l.n = l.whole = n;
    l.ghost = ghost;
    l.periodic = periodic;
    std::ptrdiff_t s = 1;
    for (int d = 0; d < 3; ++d) {
      l.stride[d] = s;
      l.origin += ghost[d] * s;
      s *= n[d] + 2 * ghost[d];
    }
    l.size = static_cast<std::size_t>(s);
    return l;
  }

  bool is_split(int d) const { return n[d] < whole[d]; }
  // Other processes hold the rest of the box.
  bool is_cut() const { return is_split(0) || is_split(1) || is_split(2); }
  // What lies beyond an end comes by exchange(), no side of the whole box is there.
  bool seam(int d, bool upper) const {
    return periodic[d] || (upper ? first[d] + n[d] < whole[d] : first[d] > 0);
  }
  bool any_seam(int d) const { return seam(d, false) || seam(d, true); }
  bool any_seam() const { return any_seam(0) || any_seam(1) || any_seam(2); }

  std::ptrdiff_t index(int i, int j, int k) const {
    return origin + i * stride[0] + j * stride[1] + k * stride[2];
  }
  std::ptrdiff_t index(const std::array<int, 3>& at) const { return index(at[0], at[1], at[2]); }
  std::size_t count() const { return std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]); }
};

}  // namespace granvof
