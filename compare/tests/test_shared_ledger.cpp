// Energy in the terms that both codes count alike.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compare/checks/registry.hpp"
#include "compare/input/shared_ledger.hpp"

namespace granvof::compare {
namespace {

// A run of two rows, at 0 and 1 s: what each column ends at, from 0.
Run run_of(const std::vector<std::pair<std::string, double>>& columns) {
  Run run;
  run.series.columns.push_back({"time", "s", ""});
  std::vector<Value> first{0.0}, last{1.0};
  for (const auto& [name, end] : columns) {
    run.series.columns.push_back({name, "J", ""});
    first.emplace_back(0.0);
    last.emplace_back(end);
  }
  run.series.rows = {first, last};
  return run;
}

const Run continuum = run_of({{"energy_kinetic", 2.0},
                              {"energy_potential", -10.0},
                              {"energy_granular", 0.5},
                              {"lost_drag", 1.0},
                              {"lost_friction", 5.0},
                              {"lost_collisions", 0.5},
                              {"gained_dilatancy", 0.25},
                              {"lost_numerical_time", 0.75},
                              {"lost_numerical_solid", -0.5}});
const Run beads = run_of({{"energy_kinetic", 1.0},
                          {"energy_potential", -20.0},
                          {"energy_granular", 0.5},
                          {"energy_spin", 0.5},
                          {"lost_drag", 4.0},
                          {"lost_contacts", 12.0},
                          {"lost_walls", 3.0},
                          {"gained_gate", 2.0},
                          {"lost_numerical_pressure", -1.0}});

TEST(SharedLedger, AddsWhatBothCodesCountAlike) {
  EXPECT_DOUBLE_EQ(*share_of_released(continuum, "contacts", {0.0, 1.0}), 0.525);
  EXPECT_DOUBLE_EQ(*share_of_released(continuum, "agitation", {0.0, 1.0}), 0.05);
  EXPECT_DOUBLE_EQ(*share_of_released(continuum, "numerics", {0.0, 1.0}), 0.025);
  EXPECT_DOUBLE_EQ(*share_of_released(beads, "contacts", {0.0, 1.0}), 0.6);
  EXPECT_DOUBLE_EQ(*share_of_released(beads, "agitation", {0.0, 1.0}), 0.05);
  EXPECT_DOUBLE_EQ(*share_of_released(beads, "walls", {0.0, 1.0}), 0.05);
  EXPECT_DOUBLE_EQ(*share_of_released(beads, "drag", {0.0, 0.5}), 0.2);
}

TEST(SharedLedger, PowerIsASecondAndAVolume) {
  auto run = continuum;
  run.scene.tank = {0.5, 0.2, 2.0};
  EXPECT_DOUBLE_EQ(*power_of(run, "contacts", {0.0, 1.0}), 26.25);
  EXPECT_DOUBLE_EQ(*power_of(run, "contacts", {0.25, 0.5}), 26.25);
  EXPECT_FALSE(power_of(run, "contacts", {0.0, 2.0}));
  EXPECT_FALSE(power_of(run, "contacts", {0.5, 0.5}));
}

TEST(SharedLedger, IsUndefinedWithoutALedgerOrOutsideTheRun) {
  EXPECT_FALSE(share_of_released(run_of({{"energy_potential", -1.0}}), "drag", {0.0, 1.0}));
  EXPECT_FALSE(share_of_released(beads, "drag", {0.0, 2.0}));
  EXPECT_FALSE(share_of_released(beads, "drag", {0.5, 0.5}));  // nothing is released
  EXPECT_TRUE(shared_term(beads, "heat").empty());
}

TEST(SharedLedger, SharesAreMetricsOfATerm) {
  compare::Run column = beads;
  column.scene.gravity = 1.0;
  column.scene.bed = Bed{};
  column.scene.bed->nominal_height = 0.25;  // unit of T: 0.5 s
  Parameters p;
  p.term = "drag";
  p.window = Window{0.0, 2.0};
  EXPECT_DOUBLE_EQ(*find_metric("energy_share")->function(column, p, {}).value, 0.2);
  p.window = Window{0.0, 2.1};
  EXPECT_FALSE(find_metric("energy_share")->function(column, p, {}).value);
}

}  // namespace
}  // namespace granvof::compare
