// The energy ledger that a record states: it closes, and what it says of a small column.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reference/demvof/program/record_scene.hpp"
#include "reference/tests/small_case.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

// Terms of the last row of a small case, and the potential energy that it gave.
struct Budget {
  granvof::Series series;
  double given = 0.0;
  double last(const std::string& name) const { return *series.column(name).back(); }
};

Budget budget(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"time.end=0.2", "output.series_interval=0.02"});
  const granvof::test::TemporaryDirectory directory;
  demvof::RecordOptions options;
  options.out = directory.path() / "run";
  options.scratch = directory.path() / "scratch";
  options.command = "test";
  EXPECT_EQ(demvof::record_scene(demvof::test::small(overrides), options), 0);
  Budget b{granvof::read_series(options.out / "series.csv")};
  b.given = *b.series.column("energy_potential").front() - b.last("energy_potential");
  return b;
}

}  // namespace

// In air nearly all goes into contacts; nothing into pressure or liquid.
TEST(EnergyOfARecord, ADryColumnLosesItsEnergyInContacts) {
  const Budget dry = budget({"liquid=false"});
  EXPECT_GT(dry.given, 0.0);
  EXPECT_NEAR(dry.last("energy_residual"), 0.0, 0.01 * dry.given);
  EXPECT_NEAR(dry.last("lost_contacts") + dry.last("lost_walls") + dry.last("energy_kinetic") +
                  dry.last("energy_granular") + dry.last("energy_spin"),
              dry.given, 0.05 * dry.given);
  EXPECT_GT(dry.last("lost_contacts"), 0.5 * dry.given);
  EXPECT_EQ(dry.last("gained_gate"), 0.0);
}

// Beside a step: its cells hold no fluid in either account.
TEST(EnergyOfARecord, AColumnBesideAStepAccountsForItsEnergy) {
  const Budget wet = budget({"obstacle={x0=[0.0125], x1=[0.02], y0=[0], y1=[0.0025]}"});
  EXPECT_GT(wet.given, 0.0);
  for (const auto& residual : wet.series.column("energy_residual"))
    EXPECT_NEAR(*residual, 0.0, 0.01 * wet.given);
  const double phases = *wet.series.column("potential_energy_solid").front() +
                        *wet.series.column("potential_energy_liquid").front() +
                        *wet.series.column("potential_energy_gas").front();
  EXPECT_NEAR(*wet.series.column("energy_potential").front(), phases, 0.01 * phases);
}

// Under water: every term at once, in each row.
TEST(EnergyOfARecord, AColumnInWaterAccountsForItsEnergy) {
  const Budget wet = budget({});
  EXPECT_GT(wet.given, 0.0);
  for (const auto& residual : wet.series.column("energy_residual"))
    EXPECT_NEAR(*residual, 0.0, 0.01 * wet.given);
  EXPECT_GT(wet.last("lost_drag"), 0.1 * wet.given);
  EXPECT_GT(wet.last("lost_contacts"), 0.1 * wet.given);
  // Beads that rub past each other have drag on their agitation too.
  EXPECT_GT(wet.last("part_drag_mean"), 0.1 * wet.last("lost_drag"));
  EXPECT_LT(wet.last("part_drag_mean"), 0.95 * wet.last("lost_drag"));
  // Columns are for the tank's depth, as every energy of the series.
  const double beads_alone = *wet.series.column("potential_energy_solid").front() +
                             *wet.series.column("potential_energy_liquid").front() +
                             *wet.series.column("potential_energy_gas").front();
  EXPECT_NEAR(*wet.series.column("energy_potential").front(), beads_alone, 0.01 * beads_alone);
}
