// The table's runs as orders of the run engine.
#include <algorithm>

#include <gtest/gtest.h>

#include "compare/checks/evaluate.hpp"
#include "compare/checks/table.hpp"

namespace granvof::compare {
namespace {

constexpr const char* table = R"toml(
[[run]]
id = "a"
case = "s1"
set = ["grid.dx=0.005"]
[[run]]
id = "dear"
case = "s1"
[[run]]
id = "later"
case = "s2"
[[check]]
run = ["a", "dear"]
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "verify"
[[check]]
run = "dear"
metric = "core_seconds"
reference = { kind = "aim", value = 3, source = "what it may cost" }
relation = "at most"
tolerance = { absolute = 0, unit = "core-s" }
frequency = "nightly"
[[check]]
run = "later"
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "nightly"
)toml";

TEST(Plan, OnlyRunsWhoseCostIsJudgedAreTimed) {
  const Paths paths{"out/runs", "cases", "records"};
  const Table read = parse_table(table, "table");
  const auto verify = orders_of(read, Frequency::verify, paths);
  ASSERT_EQ(verify.size(), 2U);
  EXPECT_EQ(verify[0].id, "a");
  EXPECT_EQ(verify[0].case_file, "cases/s1.toml");
  EXPECT_EQ(verify[0].directory, "out/runs/a");
  EXPECT_EQ(verify[0].set, std::vector<std::string>{"grid.dx=0.005"});
  EXPECT_TRUE(std::ranges::none_of(verify, [](const Order& order) { return order.timed; }));
  const auto nightly = orders_of(read, Frequency::nightly, paths);
  ASSERT_EQ(nightly.size(), 3U);
  EXPECT_FALSE(nightly[0].timed);
  EXPECT_TRUE(nightly[1].timed);
  EXPECT_FALSE(nightly[2].timed);
}

}  // namespace
}  // namespace granvof::compare
