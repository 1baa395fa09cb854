#include <gtest/gtest.h>

#include "compare/input/energy_budget.hpp"

namespace granvof::compare {
namespace {

// A body of 1 J that falls: half becomes motion, the rest goes to drag, but for `missing`.
Run falling(double missing) {
  struct Column {
    const char *name, *kind;
    int sign;
    double end;
  };
  const std::vector<Column> columns{{"energy_kinetic", "stored", 1, 0.5},
                                    {"energy_potential", "stored", 1, 9.0},
                                    {"lost_drag", "dissipated", 1, 0.6 - missing},
                                    {"gained_walls", "outside", -1, 0.2},
                                    {"lost_numerical_time", "numerical", 1, 0.2},
                                    {"lost_numerical_solid", "numerical", 1, -0.1},
                                    {"of_which", "part", 0, 7.0},
                                    {"energy_residual", "residual", -1, 5.0}};
  Run run;
  run.series.columns.push_back({"time", "s", ""});
  std::vector<Value> first{0.0}, last{1.0};
  for (const Column& column : columns) {
    run.series.columns.push_back({column.name, "J", ""});
    run.facts.ledger.push_back({column.name, "", column.kind, column.sign, false, "", "", ""});
    first.emplace_back(std::string_view(column.name) == "energy_potential" ? 10.0 : 0.0);
    last.emplace_back(column.end);
  }
  run.series.rows = {first, last};
  return run;
}

TEST(EnergyBudgetOfARun, ClosesAndSaysWhatIsMissing) {
  EXPECT_NEAR(*closure_error(energy_budget(falling(0.0)), 2.0), 0.0, 1e-15);
  EXPECT_NEAR(*closure_error(energy_budget(falling(0.02)), 2.0), 0.01, 1e-12);
  EXPECT_NEAR(*share_of("numerical", energy_budget(falling(0.0)), 2.0), 0.05, 1e-12);
  EXPECT_NEAR(energy_budget(falling(0.0)).at("gained_walls").value.back(), -0.2, 1e-15);
}

// The sign is what the run's own ledger says, not what the name of the column suggests.
TEST(EnergyBudgetOfARun, FollowsTheLedgerOfTheRun) {
  auto run = falling(0.0);
  run.facts.ledger[3].sign = 1;
  EXPECT_NEAR(*closure_error(energy_budget(run), 2.0), 0.2, 1e-12);
}

// Half the cells, a quarter of what the scheme took: of second order; whichever sign it has.
TEST(EnergyBudgetOfARun, GivesTheOrderOfAScheme) {
  const auto taken = [](double amount) {
    return std::map<std::string, Curve>{{"scheme", {{0.0, 1.0}, {0.0, amount}}}};
  };
  EXPECT_DOUBLE_EQ(*order_of("scheme", taken(-0.1), taken(-0.4), 2.0), 2.0);
  EXPECT_DOUBLE_EQ(*order_of("scheme", taken(0.1), taken(0.4), 4.0), 1.0);
  EXPECT_DOUBLE_EQ(*order_of("scheme", taken(0.4), taken(0.1), 2.0), -2.0);
  EXPECT_FALSE(order_of("scheme", taken(0.0), taken(0.1), 2.0));
  EXPECT_FALSE(order_of("scheme", taken(0.1), taken(0.0), 2.0));
  EXPECT_FALSE(order_of("scheme", taken(0.1), taken(0.1), 1.0));
  EXPECT_FALSE(order_of("other", taken(0.1), taken(0.4), 2.0));
}

TEST(EnergyBudgetOfARun, IsUndefinedWithoutItsColumns) {
  auto run = falling(0.0);
  EXPECT_FALSE(closure_error(energy_budget(run), std::nullopt));
  run.series.columns[3].name = "other";
  EXPECT_TRUE(energy_budget(run).empty());
  run.facts.ledger.clear();
  EXPECT_TRUE(energy_budget(run).empty());
  EXPECT_FALSE(closure_error({}, 1.0));
  EXPECT_FALSE(share_of("lost_drag", {}, 1.0));
}

}  // namespace
}  // namespace granvof::compare
