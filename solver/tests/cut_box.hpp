// A box that a team of processes shares in slabs, for tests that hold it to the box in one piece.
#pragma once

#include <array>

#include <gtest/gtest.h>

#include "solver/grid/slabs.hpp"
#include "solver/tests/team.hpp"

namespace granvof::test {

struct Cut {
  const char* name;
  std::array<int, 3> n;
  int dim;
  std::array<bool, 3> periodic;
  int ranks;
};
inline constexpr auto name_of_cut = [](const auto& tested) { return std::string(tested.param.name); };

// work(layout of the slab, which names its communicator) in every process at once.
template <typename Work>
void in_all_slabs(const Cut& cut, const Layout& whole, Work&& work) {
  Team team(cut.ranks, Boxes::slabs);
  ASSERT_NO_THROW(team.run([&](int rank, const Communicator& processes) {
    Layout part = slab_of(whole, cut.dim, cut.ranks, rank);
    part.communicator = &processes;
    work(part);
  }));
}

}  // namespace granvof::test
