// Checks of every run that the table's other checks read.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "compare/checks/table.hpp"
#include "compare/tests/toml_refusal.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

const std::string named = R"toml(
[[run]]
id = "s1"

[[run]]
id = "s2"

[[run]]
id = "thick"
case = "s2"

[[run]]
id = "nobody-reads-it"

[[check]]
run = ["s1", "s2"]
metric = "run_out"
at = 2
reference = { kind = "DEM" }
tolerance = { relative = 0.1 }
frequency = "nightly"

[[check]]
run = "s1"
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "short"

[[check]]
run = "s2"
metric = "run_out_distance"
against = "thick"
window = [0, 10]
reference = { kind = "theory", value = 0, source = "the same flow" }
tolerance = { absolute = 1e-6, unit = "-" }
frequency = "weekly"
)toml";

const std::string failure = R"(expected_failure = { run = "s2", reason = "why", distance = 1 })";
const std::string of_every_run = R"toml(
[[check]]
run = "*"
metric = "warnings"
reference = { kind = "theory", value = 0, source = "monitors" }
relation = "at most"
tolerance = { absolute = 0, unit = "-" }
)toml" + failure;

TEST(EveryRun, IsCheckedAsOftenAsItIsRead) {
  const Table table = parse_table(named + of_every_run, "checks.toml");
  ASSERT_EQ(table.checks.size(), 7u);
  const auto expect = [&](std::size_t row, const std::string& id, Frequency frequency, bool fails) {
    EXPECT_EQ(table.checks[row].id, id);
    EXPECT_EQ(table.checks[row].frequency, frequency) << id;
    EXPECT_EQ(table.checks[row].expected_failure.has_value(), fails) << id;
  };
  expect(4, "s1.warnings.theory", Frequency::short_, false);
  expect(5, "s2.warnings.theory", Frequency::nightly, true);
  expect(6, "thick.warnings.theory", Frequency::weekly, false);  // what another is held against is made too
}

TEST(EveryRun, ItsExpectedFailuresNameTheirRunsAndItsFrequencyIsTheOthers) {
  const auto with = [](const std::string& by) {
    return test::refusal(
        [&] { parse_table(named + test::with_line_replaced(of_every_run, failure, by), "checks.toml"); });
  };
  EXPECT_NE(with(R"(expected_failure = { reason = "why", distance = 1 })").find("of which runs"),
            std::string::npos);
  EXPECT_NE(with(R"(frequency = "verify")").find("as often as another"), std::string::npos);
  EXPECT_NE(with(R"(expected_failure = { run = "nobody-reads-it", reason = "why", distance = 1 })")
                .find("no run of the check"),
            std::string::npos);
}

// What no run of the project's own table may be without.
TEST(EveryRun, OfTheShippedTableIsHeldToItsMonitorsAndItsEnergy) {
  const Table table = read_table(cases_directory() / "../compare/checks.toml");
  for (const std::string metric : {"warnings", "energy_closure"}) {
    for (const Check& check : table.checks) {
      const bool held = std::ranges::any_of(table.checks, [&](const Check& other) {
        return other.run == check.run && other.metric == metric && other.frequency <= check.frequency;
      });
      EXPECT_TRUE(held) << check.run << " " << metric;
    }
  }
}

}  // namespace
}  // namespace granvof::compare
