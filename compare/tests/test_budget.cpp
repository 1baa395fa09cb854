// What a walk may cost, and that it is kept to; cells and methods that a walk takes by itself.
#include <filesystem>

#include <gtest/gtest.h>

#include "compare/study/advise_scene.hpp"
#include "compare/study/budget.hpp"
#include "compare/study/study_file.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

const std::filesystem::path s1 = cases_directory() / "s1.toml";

// Each run takes `factor` times what is estimated.
class FakeRunner : public Runner {
 public:
  double factor = 1.0;
  int runs = 0;
  bool kept = false;
  Outcome run(const Job& job) override {
    ++runs;
    Outcome made;
    made.core_seconds = factor * estimated_seconds(job, *this);
    made.repeats = 1;
    return made;
  }
  bool has(const Job&) override { return kept; }
};

const Job fine{s1, {"grid.dx=0.00125"}};

TEST(Budget, ARunThatWouldGoBeyondItIsNotStarted) {
  FakeRunner inner;
  const double one = estimated_seconds(fine, inner);
  BudgetedRunner runner(inner, 2.5 * one);
  EXPECT_TRUE(runner.run(fine).failure.empty());
  EXPECT_TRUE(runner.run(fine).failure.empty());
  const Outcome third = runner.run(fine);
  EXPECT_NE(third.failure.find("left out"), std::string::npos) << third.failure;
  EXPECT_EQ(inner.runs, 2);
  EXPECT_EQ(runner.left_out(), 1);
}

TEST(Budget, WhatRunsTookCorrectsTheEstimate) {
  FakeRunner inner;
  inner.factor = 3.0;
  BudgetedRunner runner(inner, 5.0 * estimated_seconds(fine, inner));
  runner.run(fine);  // took 3; the next is expected to as well
  EXPECT_FALSE(runner.run(fine).failure.empty());
  EXPECT_EQ(inner.runs, 1);
}

TEST(Budget, KeptRunsCostNothing) {
  FakeRunner inner;
  inner.kept = true;
  EXPECT_EQ(estimated_seconds(fine, inner), 0.0);
  const Plan plan = plan_of({0.00125}, {{fine, fine}}, inner);
  EXPECT_EQ(plan.grids[0].kept, 2);
  EXPECT_EQ(plan.core_seconds(), 0.0);
}

TEST(Budget, CheapRunsAreTimedSeveralTimes) {
  FakeRunner inner;
  const Job coarse{s1, {"grid.dx=0.01"}};
  EXPECT_DOUBLE_EQ(estimated_seconds(coarse, inner),
                   3.0 * estimate_cost(load_scene(s1, coarse.set)).core_seconds);
  EXPECT_DOUBLE_EQ(estimated_seconds(fine, inner), estimate_cost(load_scene(s1, fine.set)).core_seconds);
}

TEST(AdviseDefaults, NoCellIsSmallerThanAGrain) {
  const Scene scene = load_scene(s1);  // grains of 0.8 mm
  EXPECT_EQ(cells_to_advise({0.005, 0.0025, 0.00125, 0.000625}, scene),
            (std::vector<double>{0.005, 0.0025, 0.00125}));
  EXPECT_EQ(cells_to_advise({}, scene), (std::vector<double>{0.01, 0.005, 0.0025, 0.00125}));
  const Scene large = load_scene(s1, std::vector<std::string>{"solid.diameter=6e-3"});
  EXPECT_EQ(cells_to_advise({}, large), (std::vector<double>{0.02, 0.01}));
  const Scene larger = load_scene(s1, std::vector<std::string>{"solid.diameter=12e-3"});
  EXPECT_EQ(cells_to_advise({}, larger), (std::vector<double>{0.04, 0.02}));
}

TEST(AdviseDefaults, NeitherExplicitContactsNorAnotherScenesGrains) {
  const Study study = read_study(cases_directory() / "../compare/study.toml");
  const auto has = [](const std::vector<Method>& methods, std::string_view part) {
    return std::any_of(methods.begin(), methods.end(),
                       [&](const Method& m) { return m.name.find(part) != std::string::npos; });
  };
  const auto any = methods_to_advise(study, nullptr);
  EXPECT_FALSE(has(any, "explicit"));
  EXPECT_FALSE(has(any, "mu(I)"));
  EXPECT_FALSE(has(any, "sourced choices"));
  EXPECT_TRUE(has(any, "preset sourced"));
  EXPECT_TRUE(has(any, "preset advised"));
  const auto charted = methods_to_advise(study, &study.charts.front());
  EXPECT_FALSE(has(charted, "explicit"));
  EXPECT_TRUE(has(charted, "sourced choices"));
}

TEST(AdviseRefusal, IsSaidAfterWhatTheFigureIs) {
  AdviseReport report;
  report.scene = "mine";
  report.input.quantity = parse_quantity("run_out", std::nullopt);
  report.target.kind = kind_of_own;
  report.target.floor = 0.047;
  report.refusal = "cannot be told: ...";
  const auto lines = advise_summary(report);
  EXPECT_NE(lines[1].find("GRID ERROR ONLY"), std::string::npos);
  EXPECT_EQ(lines.back(), report.refusal);
  report.target.kind = "DEM";
  EXPECT_NE(advise_summary(report)[1].find("model and grid together"), std::string::npos);
}

TEST(AdviseRefusal, PresetsThatDifferByMoreThanTheToleranceAreAWarning) {
  AdviseReport report;
  report.input.tolerance = 0.05;
  report.input.quantity = parse_quantity("run_out", std::nullopt);
  report.target.kind = kind_of_own;
  report.model = "preset advised";
  report.others = {{"preset sourced", 0.18, ""}, {"plain", std::nullopt, "step collapse"}};
  const auto warns = [](const AdviseReport& r) {
    const auto lines = advise_summary(r);
    return std::any_of(lines.begin(), lines.end(),
                       [](const std::string& l) { return l.starts_with("WARNING"); });
  };
  EXPECT_TRUE(warns(report));
  report.others[0].distance = 0.04;
  EXPECT_FALSE(warns(report));
}

}  // namespace
}  // namespace granvof::compare
