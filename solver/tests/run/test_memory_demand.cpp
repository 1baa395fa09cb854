// Memory that a run is refused for.
#include <gtest/gtest.h>

#include "solver/run/memory_demand.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

// Each of several processes needs less than one, and the lowest more than its share: it has the whole state.
TEST(MemoryDemand, OfSeveralProcessesIsThatOfASlabAndOfTheWholeState) {
  const Scene scene = test::column_scene({"tank.size=[16, 8]"});
  const double cells = 1600.0 * 800.0, state = cells * 13.0 * sizeof(double), one = memory_demand(scene);
  for (const int processes : {2, 8, 100}) {
    const double each = memory_demand(scene, processes);
    EXPECT_LT(each, one) << processes;
    EXPECT_GT(each, one / processes + 2.0 * state) << processes;
  }
}

}  // namespace
}  // namespace granvof
