// The one table of what metrics take.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "compare/checks/registry.hpp"
#include "compare/checks/theory.hpp"

namespace granvof::compare {
namespace {

TEST(Parameters, WhatIsNeededIsInTheTable) {
  for (const auto needed : {&Needs::window, &Needs::at, &Needs::quiet, &Needs::level, &Needs::published,
                            &Needs::against, &Needs::term, &Needs::scheme}) {
    Needs needs;
    needs.*needed = true;
    EXPECT_FALSE(is_complete(needs, Parameters{}));
  }
  EXPECT_TRUE(is_complete(Needs{}, Parameters{}));
}

TEST(Parameters, AreCompleteOnceAllAreGiven) {
  const Needs needs{.window = true, .published = true};
  Parameters given;
  given.window = Window{0.0, 1.0};
  given.published = "file.csv";
  EXPECT_FALSE(is_complete(needs, given));  // a column goes with it
  given.column = "front";
  EXPECT_TRUE(is_complete(needs, given));
}

TEST(Parameters, TellRowsOfAMetricApart) {
  Parameters given;
  EXPECT_EQ(labelled("period", given), "period");
  given.window = Window{0.0, 1.0};
  given.level = 0.25;
  EXPECT_EQ(labelled("period", given), "period");
  given.at = 10.0;
  given.column = "front";
  EXPECT_EQ(labelled("run_out", given), "run_out@10-front");
  given.against = "s1-plain";
  given.term = "drag";
  EXPECT_EQ(labelled("run_out", given), "run_out@10-s1-plain-front-drag");
}

TEST(Metrics, OnlyWhatSomebodyPaysForIsACost) {
  EXPECT_TRUE(find_metric("core_seconds")->of_cost);
  EXPECT_EQ(std::ranges::count_if(metrics(), [](const MetricEntry& metric) { return metric.of_cost; }), 1);
}

// Deep water of 2 m under air, 0.2 m long: omega^2 = g k (1 - 1/1000) / (1 + 1/1000) to 1e-10.
TEST(Theory, PeriodOfTheFirstModeInDeepWater) {
  compare::Run run;
  run.scene.tank = {0.2, 4.0, 0.1};
  run.scene.gravity = 9.81;
  run.scene.liquid.density = 1000.0;
  run.scene.gas.density = 1.0;
  run.series.columns = {{"time", "s", ""}, {"liquid_height_left", "m", ""}, {"liquid_height_right", "m", ""}};
  run.series.rows = {{0.0, 2.01, 1.99}};
  const auto period = find_formula("sloshing_period")->function(run, {});
  ASSERT_TRUE(period);
  EXPECT_NEAR(*period, 0.5067, 1e-4);  // 2 pi / sqrt(9.81 pi / 0.2 * 999 / 1001)
  run.series.rows.clear();
  EXPECT_FALSE(find_formula("sloshing_period")->function(run, {}));
}

}  // namespace
}  // namespace granvof::compare
