#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "compare/checks/evaluate.hpp"
#include "compare/checks/table.hpp"
#include "compare/tests/toml_refusal.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

const std::string runs = R"toml([[run]]
id = "s1"
set = ["grid.dx=0.0025"]

[[run]]
id = "s2"
)toml";

const std::string good = runs + R"toml(
[[check]]
run = ["s1", "s2"]
metric = "run_out"
at = 2
reference = { kind = "published", value = 0.3, source = "somewhere", band = 0.05 }
tolerance = { relative = 0.1 }
frequency = "nightly"
expected_failure = { reason = "why", distance = 0.2 }

[[check]]
run = "s1"
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "verify"
)toml";

std::string message_of(const std::string& text) {
  return test::refusal([&] { parse_table(text, "checks.toml"); });
}

std::string replaced(const std::string& line, const std::string& by) {
  return test::with_line_replaced(good, line, by);
}

TEST(Table, ARowForEachReferenceInstantAndRun) {
  const Table table = parse_table(runs + R"toml([[check]]
run = ["s1", "s2"]
metric = "run_out"
at = [2, 5]
reference = [{ kind = "published", value = 0.3, source = "somewhere" }, { kind = "DEM", band = 0.02 }]
tolerance = { absolute = 0.1, unit = "-" }
frequency = "verify"
)toml",
                                  "checks.toml");
  ASSERT_EQ(table.checks.size(), 8u);
  EXPECT_EQ(table.checks[1].id, "s2.run_out@2.published");
  EXPECT_EQ(table.checks[6].id, "s1.run_out@5.DEM");
  EXPECT_DOUBLE_EQ(*table.checks[6].parameters.at, 5.0);
  EXPECT_EQ(*table.checks[7].reference.record, "s2");  // without a name: that of the run
  EXPECT_EQ(table.checks[7].reference.source, "reference/results/s2");
  EXPECT_DOUBLE_EQ(table.checks[7].reference.band, 0.02);
}

TEST(Table, ADistanceForEachInstantOrOneForAll) {
  const auto distances = [](const std::string& distance) {
    const Table table = parse_table(runs + R"toml([[check]]
run = ["s1", "s2"]
metric = "run_out"
at = [2, 5]
reference = { kind = "DEM" }
tolerance = { absolute = 0.1, unit = "-" }
frequency = "verify"
expected_failure = { reason = "why", distance = )toml" +
                                        distance + " }",
                                    "checks.toml");
    std::vector<double> found;
    for (const Check& check : table.checks) found.push_back(check.expected_failure.value().distance);
    return found;
  };
  EXPECT_EQ(distances("[0.2, 0.3]"), (std::vector{0.2, 0.2, 0.3, 0.3}));  // both runs at 2, both at 5
  EXPECT_EQ(distances("0.4"), (std::vector{0.4, 0.4, 0.4, 0.4}));
}

const std::string beside = R"toml([[run]]
id = "s1"

[[run]]
id = "s2"

[[run]]
id = "s1-other"
beside = "s1"
set = ["model.preset=sourced"]

[[run]]
id = "s2-other"
beside = "s2"
set = ["model.preset=sourced"]
frequency = "nightly"

[[check]]
run = ["s1", "s2"]
metric = "run_out"
at = [2, 5]
reference = [{ kind = "DEM" }, { kind = "regression", value = 1, source = "this code" }]
tolerance = { absolute = 0.1, unit = "-" }
frequency = "verify"
expected_failure = { reason = "why", distance = 0.2 }

[[check]]
run = "s1"
metric = "run_out_distance"
against = "s2"
window = [0, 10]
reference = { kind = "published", value = 0, source = "somewhere" }
tolerance = { absolute = 0.2, unit = "-" }
frequency = "verify"
)toml";

const Check& row_of(const Table& table, const std::string& id) {
  const auto found = std::ranges::find(table.checks, id, &Check::id);
  if (found == table.checks.end()) throw std::runtime_error("no row " + id);
  return *found;
}

TEST(Table, ARunBesideAnotherIsHeldToTheSame) {
  const Table table = parse_table(beside, "checks.toml");
  EXPECT_EQ(table.runs[2].case_name, "s1");
  ASSERT_EQ(table.checks.size(), 4u * 2u + 4u + 2u);  // DEM of four runs, regressions of two, the distances
  for (const char* at : {"2", "5"}) {
    const Check& other = row_of(table, std::string("s1-other.run_out@") + at + ".DEM");
    EXPECT_EQ(*other.reference.record, "s1");  // that of the case
    EXPECT_EQ(other.tolerance.value, 0.1);
    EXPECT_EQ(other.frequency, Frequency::verify);
    EXPECT_FALSE(other.expected_failure) << "known of the runs that the check names";
    EXPECT_TRUE(row_of(table, std::string("s1.run_out@") + at + ".DEM").expected_failure);
    EXPECT_EQ(row_of(table, std::string("s2-other.run_out@") + at + ".DEM").frequency, Frequency::nightly);
  }
  EXPECT_EQ(row_of(table, "s1.run_out_distance-s2.published").parameters.against, "s2");
  EXPECT_EQ(row_of(table, "s1-other.run_out_distance-s2-other.published").parameters.against, "s2-other");
}

TEST(Table, AnExpectedFailureOfSomeRunsAtSomeInstants) {
  const std::string some =
      "expected_failure = [{ run = \"s1\", at = 5, reason = \"late\", distance = 0.3 }, { run = "
      "\"s1-other\", "
      "reason = \"other\", distance = [0.4, 0.5] }]";
  const std::string all = "expected_failure = { reason = \"why\", distance = 0.2 }";
  const Table table = parse_table(test::with_line_replaced(beside, all, some), "checks.toml");
  EXPECT_FALSE(row_of(table, "s1.run_out@2.DEM").expected_failure);
  EXPECT_EQ(row_of(table, "s1.run_out@5.DEM").expected_failure->reason, "late");
  EXPECT_FALSE(row_of(table, "s2.run_out@5.DEM").expected_failure);
  EXPECT_EQ(row_of(table, "s1-other.run_out@2.DEM").expected_failure->distance, 0.4);
  EXPECT_EQ(row_of(table, "s1-other.run_out@5.DEM").expected_failure->distance, 0.5);
  const auto refused = [&](const std::string& given) {
    return message_of(test::with_line_replaced(beside, all, given));
  };
  EXPECT_NE(refused("expected_failure = { run = \"s3\", reason = \"w\", distance = 1 }")
                .find("'s3' given, which is no run of the check"),
            std::string::npos);
  EXPECT_NE(refused("expected_failure = { at = 3, reason = \"w\", distance = 1 }")
                .find("3 given, which is no instant of the check"),
            std::string::npos);
  EXPECT_NE(refused("expected_failure = [{ reason = \"w\", distance = 1 }, { run = \"s1\", reason = \"w\", "
                    "distance = 1 }]")
                .find("is in two of them"),
            std::string::npos);
}

TEST(Table, RefusesARunBesideNothing) {
  const auto refused = [](const std::string& line, const std::string& by) {
    return message_of(test::with_line_replaced(beside, line, by));
  };
  EXPECT_NE(refused("beside = \"s1\"", "beside = \"s3\"").find("no [[run]] has the id 's3'"),
            std::string::npos);
  EXPECT_NE(refused("set = [\"model.preset=sourced\"]", "").find("without 'set' it is the run"),
            std::string::npos);
  EXPECT_NE(refused("id = \"s2\"", "id = \"s2\"\nfrequency = \"nightly\"").find("only a run beside another"),
            std::string::npos);
  EXPECT_NE(refused("beside = \"s2\"", "case = \"s2\"").find("frequency"), std::string::npos);
  EXPECT_NE(refused("beside = \"s2\"\nset = [\"model.preset=sourced\"]",
                    "beside = \"s2\"\nset = [\"model.preset=paper\"]")
                .find("no [[run]] beside 's2' has the 'set' of 's1-other'"),
            std::string::npos);
}

// Every scene of the paper that is run with the paper's preset is run with the default one too.
TEST(Table, TheShippedOneHasTheAdvisedRunBesideEveryScene) {
  const Table table = read_table(cases_directory() / "../compare/checks.toml");
  const std::set<std::string> dear{"sw", "fw"};  // a quarter of an hour each
  const auto of_beads = [](const PlannedRun& run) {
    return run.case_name.starts_with("beads/");
  };  // own preset
  for (const PlannedRun& run : table.runs) {
    if (!run.set.empty() || dear.contains(run.id) || of_beads(run)) continue;
    EXPECT_TRUE(std::ranges::any_of(table.runs, [&](const PlannedRun& other) {
      return other.beside == run.id && other.set == std::vector<std::string>{"model.preset=advised"};
    })) << run.id;
  }
}

TEST(Table, ReadsRowsAndExpandsRuns) {
  const Table table = parse_table(good, "checks.toml");
  ASSERT_EQ(table.runs.size(), 2u);
  EXPECT_EQ(table.runs[0].case_name, "s1");
  EXPECT_EQ(table.runs[0].set, std::vector<std::string>{"grid.dx=0.0025"});
  ASSERT_EQ(table.checks.size(), 3u);
  EXPECT_EQ(table.checks[0].id, "s1.run_out@2.published");
  EXPECT_EQ(table.checks[1].id, "s2.run_out@2.published");
  EXPECT_DOUBLE_EQ(*table.checks[1].parameters.at, 2.0);
  EXPECT_DOUBLE_EQ(table.checks[0].reference.band, 0.05);
  EXPECT_TRUE(table.checks[0].tolerance.relative);
  EXPECT_EQ(table.checks[0].expected_failure->reason, "why");
  EXPECT_EQ(table.checks[2].tolerance.unit, "-");
}

TEST(Table, RowsAreDueAtTheirFrequencyAndAbove) {
  const Table table = parse_table(good, "checks.toml");
  EXPECT_EQ(due_checks(table, Frequency::verify).size(), 1u);
  EXPECT_EQ(due_checks(table, Frequency::nightly).size(), 3u);
  ASSERT_EQ(due_runs(table, Frequency::verify).size(), 1u);
  EXPECT_EQ(due_runs(table, Frequency::verify)[0].id, "s1");
  EXPECT_EQ(due_runs(table, Frequency::weekly).size(), 2u);
}

struct BadInput {
  std::string line, by, place, what;
};

class TableBadInput : public testing::TestWithParam<BadInput> {};

TEST_P(TableBadInput, IsNamedWithItsPlace) {
  const std::string message = message_of(replaced(GetParam().line, GetParam().by));
  EXPECT_EQ(message.rfind("checks.toml:" + GetParam().place, 0), 0u) << message;
  EXPECT_NE(message.find(GetParam().what), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, TableBadInput,
    testing::Values(
        BadInput{"metric = \"run_out\"", "metric = \"runout\"", "10:", "'runout' given; allowed: run_out"},
        BadInput{"at = 2", "at = \"2\"", "11:", "expected a finite number"},
        BadInput{"at = 2", "at = nan", "11:", "expected a finite number"},
        BadInput{"at = 2\n", "\n", "10:", "run_out needs the key 'at'"},
        BadInput{"at = 2", "at = 2\nwindow = [0, 1]", "12:", "takes no such parameter"},
        BadInput{"kind = \"published\"", "kind = \"guess\"",
                 "12:", "allowed: theory, published, DEM, aim, regression"},
        BadInput{"value = 0.3, ", "", "12:", "exactly one of"},
        BadInput{"value = 0.3", "formula = \"floating_period\"", "12:", "is in s"},
        BadInput{"value = 0.3", "formula = \"nothing\"", "12:", "'nothing' given"},
        BadInput{"value = 0.3", "record = \"s1\"", "12:", "only a reference of kind DEM"},
        BadInput{", source = \"somewhere\"", "", "12:", "'source' is missing"},
        BadInput{"{ relative = 0.1 }", "{ relative = -0.1 }", "13:", "0 or more"},
        BadInput{"{ relative = 0.1 }", "{ relative = 0.1, absolute = 1 }", "13:", "one of"},
        BadInput{"unit = \"-\"", "unit = \"m\"", "21:", "'m' given; solid_volume_error is in -"},
        BadInput{"frequency = \"nightly\"", "frequency = \"often\"",
                 "14:", "allowed: short, verify, nightly, weekly"},
        BadInput{"frequency = \"nightly\"", "frequency = \"nightly\"\nspeed = 1",
                 "15:", "unknown key; allowed"},
        BadInput{"run = \"s1\"", "run = \"s3\"", "18:", "no [[run]] has the id 's3'; there are: s1, s2"},
        BadInput{"set = [\"grid.dx=0.0025\"]", "set = [\"grid.dx\"]", "3:", "expected key=value"},
        BadInput{"id = \"s2\"", "id = \"s1\"", "6:", "given twice"},
        BadInput{"run = [\"s1\", \"s2\"]", "run = [\"s1\", \"s1\"]", "8:", "checked twice"},
        BadInput{"distance = 0.2", "distance = [0.2, 0.3]",
                 "15:", "2 numbers given; allowed: one, or as many as 'at' has (1)"},
        BadInput{"distance = 0.2", "distance = [-0.2]", "15:", "-0.2 given; allowed: 0 or more"},
        BadInput{"at = 2", "at = ", "11:", ""}));

TEST(Table, AWindowMustGoForward) {
  const std::string text = runs + R"toml(
[[check]]
run = "s1"
metric = "period"
window = [6, 3]
reference = { kind = "theory", formula = "floating_period" }
tolerance = { relative = 0.1 }
frequency = "verify"
)toml";
  EXPECT_NE(message_of(text).find("begin must come before end"), std::string::npos);
}

TEST(Table, AMissingFileIsNamed) {
  try {
    read_table("no/such/checks.toml");
    FAIL();
  } catch (const TableError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/checks.toml"), std::string::npos);
  }
}

// Nothing to check is no success.
TEST(Table, WithoutAnyCheckItIsRefused) {
  EXPECT_NE(message_of("").find("there is no [[check]]"), std::string::npos);
  EXPECT_NE(message_of("[[run]]\nid = \"s1\"\n").find("there is no [[check]]"), std::string::npos);
}

// Names become parts of paths.
TEST(Table, ANameLeadsOutOfNowhere) {
  const auto expect_refused = [](const std::string& key_and_name) {
    EXPECT_NE(message_of("[[run]]\n" + key_and_name + "\n").find("a name has letters"), std::string::npos)
        << key_and_name;
  };
  for (const std::string name : {"../s1", "..", ".", "/tmp/s1", "-x", "s1 ", "s1\\n"}) {
    expect_refused("id = \"" + name + "\"");
    expect_refused("id = \"s1\"\ncase = \"" + name + "\"");
  }
  expect_refused("id = \"a/b\"");  // a case may be in a folder of cases, and no deeper
  for (const std::string name : {"a/", "a/..", "a/b/c", "a//b", "./a"})
    expect_refused("id = \"s1\"\ncase = \"" + name + "\"");
}

TEST(Table, ACaseMayBeInAFolder) {
  const Table table = read_table(cases_directory() / "../compare/checks.toml");
  const auto found = std::ranges::find(table.runs, "column-paper", &PlannedRun::id);
  ASSERT_NE(found, table.runs.end());
  EXPECT_EQ(found->case_name, "invariance/column");
}

// A table with one run and a check whose expected failure holds `keys`.
std::string with_failure(const std::string& causes, const std::string& keys) {
  return causes + R"toml(
[[run]]
id = "s1"
[[check]]
run = "s1"
metric = "run_out"
at = 2
reference = { kind = "DEM" }
tolerance = { relative = 0.1 }
frequency = "verify"
expected_failure = { )toml" +
         keys + "reason = \"w\", distance = 1 }\n";
}

TEST(Table, EveryExpectedFailureNamesADeclaredCause) {
  const std::string causes = "[[cause]]\nkey = \"toe\"\ntext = \"The toe.\"\n";
  const Table table = parse_table(with_failure(causes, "cause = \"toe\", "), "checks.toml");
  EXPECT_EQ(table.checks[0].expected_failure->cause, "toe");
  EXPECT_EQ(table.causes[0].text, "The toe.");
  EXPECT_NE(message_of(with_failure(causes, "")).find("cause"), std::string::npos);
  EXPECT_NE(message_of(with_failure(causes, "cause = \"nose\", ")).find("there are: toe"), std::string::npos);
  EXPECT_NE(message_of(with_failure(causes + causes, "cause = \"toe\", ")).find("given twice"),
            std::string::npos);
  const std::string idle = causes + "[[cause]]\nkey = \"idle\"\ntext = \"Nothing.\"\n";
  EXPECT_NE(message_of(with_failure(idle, "cause = \"toe\", ")).find("no expected failure has this cause"),
            std::string::npos);
}

TEST(Table, TheShippedCausesAreFew) {
  const Table table = read_table(cases_directory() / "../compare/checks.toml");
  EXPECT_GT(table.causes.size(), 5u);
  EXPECT_LT(table.causes.size(), 20u);
  for (const Check& check : table.checks)
    EXPECT_FALSE(check.expected_failure && check.expected_failure->cause.empty()) << check.id;
}

TEST(Table, ADirectoryIsNoTable) {
  try {
    read_table(cases_directory());
    FAIL();
  } catch (const TableError& error) {
    EXPECT_NE(std::string(error.what()).find("Is a directory"), std::string::npos);
  }
}

}  // namespace
}  // namespace granvof::compare
