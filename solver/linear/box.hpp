// The index box the linear solvers work on: cells, or the faces of one direction.
#pragma once

#include <array>
#include <cstddef>

namespace granvof::linear {

// n[d] unknowns a direction; a direction with n[d] == 1 is not coupled (2D costs nothing for the third).
struct BoxShape {
  std::array<int, 3> n{1, 1, 1};
  std::array<bool, 3> periodic{false, false, false};
  std::size_t size() const { return std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]); }
};

}  // namespace granvof::linear
