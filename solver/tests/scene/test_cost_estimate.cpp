// Steps estimated from the scene alone, against those that `make verify` took.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::test {
namespace {

Scene shipped(const std::string& name, const std::vector<std::string>& set = {}) {
  return load_scene(cases_directory() / (name + ".toml"), set);
}

TEST(CostEstimate, IsWithinAFactorOfTwoOfTheStepsOfRealRuns) {
  struct Taken {
    std::string scene;
    double steps;
  };
  for (const Taken& taken :
       {Taken{"dam-break", 268}, Taken{"dry-column", 306}, Taken{"float-full-r04", 1239}, Taken{"heap", 519},
        Taken{"pool", 4008}, Taken{"s1", 241}, Taken{"s2", 372}, Taken{"sloshing", 758}}) {
    const double steps = estimate_cost(shipped(taken.scene)).steps;
    EXPECT_GT(steps, 0.5 * taken.steps) << taken.scene;
    EXPECT_LT(steps, 2.0 * taken.steps) << taken.scene;
  }
}

// Of a processor of 2023; another may be twice as fast.
TEST(CostEstimate, IsWithinAFactorOfFiveOfTheCoreSecondsOfRealRuns) {
  struct Taken {
    std::string scene;
    double core_seconds;
  };
  for (const Taken& taken :
       {Taken{"dam-break", 0.9}, Taken{"dry-column", 2.57}, Taken{"float-full-r04", 3.69},
        Taken{"heap", 4.63}, Taken{"s1", 2.26}, Taken{"s2", 3.45}, Taken{"sloshing", 0.84}}) {
    const double estimate = estimate_cost(shipped(taken.scene)).core_seconds;
    EXPECT_GT(estimate, 0.2 * taken.core_seconds) << taken.scene;
    EXPECT_LT(estimate, 5.0 * taken.core_seconds) << taken.scene;
  }
}

TEST(CostEstimate, GrowsWithCellsAndWithShorterSteps) {
  const CostEstimate coarse = estimate_cost(shipped("s1"));
  const CostEstimate fine = estimate_cost(shipped("s1", {"grid.dx=0.00125"}));
  EXPECT_DOUBLE_EQ(fine.cells, 4.0 * coarse.cells);
  EXPECT_GT(fine.steps, 1.5 * coarse.steps);
  EXPECT_LT(fine.steps, 2.01 * coarse.steps);
  EXPECT_GT(fine.core_seconds, 4.0 * coarse.core_seconds);
  EXPECT_GT(estimate_cost(shipped("s1", {"numerics.dt_max=1e-4"})).steps, 7000.0);
}

}  // namespace
}  // namespace granvof::test
