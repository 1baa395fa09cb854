#include <gtest/gtest.h>

#include "compare/input/energy_budget.hpp"

namespace granvof::compare {
namespace {

// A body of 1 J that falls: half becomes motion, the rest goes to drag, but for `missing`.
Run falling(double missing) {
  Run run;
  const std::vector<std::pair<std::string, double>> ends{
      {"energy_kinetic", 0.5},        {"energy_potential", 9.0},        {"energy_granular", 0.0},
      {"energy_elastic", 0.0},        {"lost_drag", 0.6 - missing},     {"lost_friction", 0.0},
      {"lost_viscosity", 0.0},        {"lost_collisions", 0.0},         {"lost_outflow", 0.0},
      {"gained_walls", 0.2},          {"gained_dilatancy", 0.0},        {"gained_shear_dilatancy", 0.0},
      {"lost_numerical_time", 0.2},   {"lost_numerical_momentum", 0.0}, {"lost_numerical_volume", -0.1},
      {"lost_numerical_stress", 0.0}, {"lost_numerical_granular", 0.0}};
  run.series.columns.push_back({"time", "s", ""});
  std::vector<Value> first{0.0}, last{1.0};
  for (const auto& [name, end] : ends) {
    run.series.columns.push_back({name, "J", ""});
    first.emplace_back(name == "energy_potential" ? 10.0 : 0.0);
    last.emplace_back(end);
  }
  run.series.rows = {first, last};
  return run;
}

TEST(EnergyBudgetOfARun, ClosesAndSaysWhatIsMissing) {
  EXPECT_NEAR(*closure_error(energy_budget(falling(0.0)), 2.0), 0.0, 1e-15);
  EXPECT_NEAR(*closure_error(energy_budget(falling(0.02)), 2.0), 0.01, 1e-12);
  EXPECT_NEAR(*numerical_share(energy_budget(falling(0.0)), 2.0), 0.05, 1e-12);
  EXPECT_NEAR(energy_budget(falling(0.0)).at("outside").value.back(), -0.2, 1e-15);
}

TEST(EnergyBudgetOfARun, IsUndefinedWithoutItsColumns) {
  auto run = falling(0.0);
  EXPECT_FALSE(closure_error(energy_budget(run), std::nullopt));
  run.series.columns[3].name = "other";
  EXPECT_TRUE(energy_budget(run).empty());
  EXPECT_FALSE(closure_error({}, 1.0));
}

}  // namespace
}  // namespace granvof::compare
