// The line of a run in a terminal.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/run/progress_line.hpp"

namespace granvof {
namespace {

TEST(ProgressLine, PlotsTheWayOfTheFront) {
  EXPECT_EQ(front_plot(std::vector{0.1, 0.1, 0.2, 0.3, 0.45}), "front ▁▁▃▅█ 0.45 m");
  EXPECT_EQ(front_plot(std::vector{0.3, 0.2}), "front █▁ 0.2 m");  // a front may go back
}

TEST(ProgressLine, OfManyRowsPlotsTheFirstTheLastAndSomeBetween) {
  std::vector<double> fronts(1001, 1.0);
  fronts.front() = 0.0;
  fronts.back() = 2.0;
  std::string middle;
  for (int i = 0; i < 18; ++i) middle += "▅";
  EXPECT_EQ(front_plot(fronts), "front ▁" + middle + "█ 2 m");
}

TEST(ProgressLine, PlotsNothingBeforeTheFrontCanHaveMoved) {
  EXPECT_EQ(front_plot({}), "");
  EXPECT_EQ(front_plot(std::vector{0.1}), "");
  EXPECT_EQ(front_plot(std::vector{0.1, 0.1}), "front ▁▁ 0.1 m");
}

TEST(ProgressLine, LeavesOutWhatDoesNotFit) {
  const std::array<std::string, 4> parts{"s1: t 1 s", "", "front ▁█ 2 m", "dt 1 s"};
  EXPECT_EQ(side_by_side(parts, 100), "s1: t 1 s  front ▁█ 2 m  dt 1 s");
  EXPECT_EQ(side_by_side(parts, 32), "s1: t 1 s  front ▁█ 2 m  dt 1 s");  // 31 characters and the cursor
  EXPECT_EQ(side_by_side(parts, 31), "s1: t 1 s  front ▁█ 2 m");
  EXPECT_EQ(side_by_side(parts, 5), "s1: t 1 s");
}

}  // namespace
}  // namespace granvof
