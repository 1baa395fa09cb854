// The walk to the cheapest configuration, on a bench whose results are formulas.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "compare/study/advise.hpp"

namespace granvof::compare {
namespace {

const Method plain{"plain", {}, "", std::nullopt};
const Method same{"same", {}, "", std::nullopt};  // as plain, by another name
const Method sharp{"sharp", {"numerics.solid_flux=limited"}, "", std::nullopt};
const Part no_les{"no LES", {"model.les=false"}, std::nullopt, ""};
const Part algebraic{"algebraic", {"model.granular_temperature=algebraic"}, std::nullopt, ""};
const Part off{"off", {"model.granular_temperature=off"}, std::nullopt, ""};

// One number is the result of a configuration; the reference is 1.
class FakeBench : public Bench {
 public:
  std::function<std::optional<double>(const Configuration&)> result;
  std::function<double(const Configuration&)> price = [](const Configuration& c) {
    double cost = std::pow(0.01 / c.cell, 3);
    if (c.method.name == "sharp") cost *= 1.5;
    for (const Part& part : c.without)
      cost *= part.name == "off" ? 0.5 : part.name == "algebraic" ? 0.7 : 0.8;
    return cost;
  };
  int trials = 0;
  double noise = 0.0;

  Trial trial(const Configuration& c) override {
    ++trials;
    const auto value = result(c);
    return value ? Trial{std::abs(*value - 1.0), price(c), "", noise}
                 : Trial{std::nullopt, price(c), "step collapse", noise};
  }
  std::optional<double> distance(const Configuration& a, const Configuration& b) override {
    const auto first = result(a);
    const auto second = result(b);
    if (!first || !second) return std::nullopt;
    return std::abs(*first - *second);
  }
  std::function<bool(const Configuration&)> reference = [](const Configuration&) { return false; };
  bool is_reference(const Configuration& c) override { return reference(c); }
  std::optional<std::vector<std::string>> overrides(const Part& part) override {
    if (part.form) return std::nullopt;
    return part.set;
  }
};

const std::vector<double> cells{0.005, 0.0025, 0.00125, 0.000625};

// First order: the error is 20 cells per metre; `sharp` has a quarter of it.
double first_order(const Configuration& c) {
  return 1.0 + (c.method.name == "sharp" ? 5.0 : 20.0) * c.cell;
}

TEST(Advise, TakesTheCheapestMethodOnTheCoarsestGridThatMeetsTheTolerance) {
  FakeBench bench;
  bench.result = first_order;
  const Advice advice = advise(cells, {plain, sharp}, {}, 0.03, bench);
  ASSERT_TRUE(advice.chosen);
  EXPECT_EQ(name_of(advice.chosen->configuration), "sharp on 5 mm");
  EXPECT_EQ(name_of(advice.confirmation->configuration), "sharp on 2.5 mm");
  EXPECT_NEAR(*advice.moved, 0.0125, 1e-12);
  EXPECT_EQ(bench.trials, 3);  // two methods on one grid, and the confirmation
}

TEST(Advise, AMethodForCoarseGridsIsNotTriedOnOthers) {
  FakeBench bench;
  bench.result = first_order;
  Method coarse = sharp;
  coarse.grids = 1;
  const Advice advice = advise(cells, {coarse}, {}, 0.02, bench);
  EXPECT_FALSE(advice.chosen);
  EXPECT_EQ(advice.steps.size(), 1u);
}

TEST(Advise, RefusesWhatMeetsTheToleranceByAccident) {
  FakeBench bench;
  bench.result = [](const Configuration& c) {
    return c.cell > 0.004 ? 1.0 : 1.0 + 20.0 * c.cell;  // right on 5 mm only
  };
  const Advice advice = advise(cells, {plain}, {}, 0.03, bench);
  ASSERT_TRUE(advice.chosen);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 1.25 mm");
  EXPECT_NE(advice.steps[1].remark.find("does not confirm"), std::string::npos);
}

TEST(Advise, SaysSoWhereNothingMeetsTheTolerance) {
  FakeBench bench;
  bench.result = first_order;
  const Advice advice = advise(cells, {plain}, {no_les}, 0.001, bench);
  EXPECT_FALSE(advice.chosen);
  EXPECT_EQ(advice.steps.size(), 3u);  // the finest grid only confirms
}

TEST(Advise, AFailedRunIsEvidenceAndNoAnswer) {
  FakeBench bench;
  bench.result = [](const Configuration& c) -> std::optional<double> {
    if (c.method.name == "sharp") return std::nullopt;
    return first_order(c);
  };
  const Advice advice = advise(cells, {sharp, plain}, {}, 0.06, bench);
  ASSERT_TRUE(advice.chosen);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 2.5 mm");
  EXPECT_EQ(advice.steps[0].remark, "step collapse");
}

TEST(Advise, LeavesOutPartsThatMoveNothing) {
  FakeBench bench;
  bench.result = [](const Configuration& c) {
    double value = first_order(c);
    for (const Part& part : c.without) value += part.name == "off" ? 0.05 : 0.001;
    return value;
  };
  const Advice advice = advise(cells, {plain}, {no_les, algebraic, off}, 0.06, bench);
  ASSERT_TRUE(advice.chosen);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 2.5 mm, algebraic, no LES");
  EXPECT_EQ(name_of(advice.confirmation->configuration), "plain on 1.25 mm, algebraic, no LES");
}

TEST(Advise, OfMethodsThatCostTheSameTheFirstIsTaken) {
  FakeBench bench;
  bench.result = first_order;
  EXPECT_EQ(name_of(advise(cells, {same, plain}, {}, 0.06, bench).chosen->configuration), "same on 2.5 mm");
  EXPECT_EQ(name_of(advise(cells, {sharp, plain}, {}, 0.06, bench).chosen->configuration), "sharp on 5 mm");
  bench.noise = 0.6;  // sharp costs half as much again
  EXPECT_EQ(name_of(advise(cells, {sharp, plain}, {}, 0.12, bench).chosen->configuration), "sharp on 5 mm");
  bench.noise = 0.4;
  EXPECT_EQ(name_of(advise(cells, {sharp, plain}, {}, 0.12, bench).chosen->configuration), "plain on 5 mm");
}

// Held against our own finest grid, the method of that grid would be its own witness.
TEST(Advise, TheReferenceItselfIsTheLastWitness) {
  FakeBench bench;
  bench.result = first_order;
  bench.reference = [](const Configuration& c) { return c.method.name == "plain" && c.cell == 0.000625; };
  const Advice other = advise(cells, {plain, same}, {}, 0.025 + 1e-9, bench);
  EXPECT_EQ(name_of(other.chosen->configuration), "same on 1.25 mm");
  const Advice alone = advise(cells, {plain}, {}, 0.025 + 1e-9, bench);
  EXPECT_EQ(name_of(alone.chosen->configuration), "plain on 1.25 mm");
  EXPECT_NE(alone.confirmation->remark.find("not independent"), std::string::npos)
      << alone.confirmation->remark;
}

TEST(Advise, ASavingWithinTheNoiseOfTheCostIsNone) {
  FakeBench bench;
  bench.result = first_order;
  bench.noise = 0.12;  // of each of two costs; no LES saves 20 %, off saves 50 %
  const Advice advice = advise(cells, {plain}, {no_les, off}, 0.06, bench);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 2.5 mm, off");
}

TEST(Advise, OfTwoChoicesOfOneKeyTheCheaperGoes) {
  FakeBench bench;
  bench.result = first_order;
  const Advice advice = advise(cells, {plain}, {algebraic, off}, 0.06, bench);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 2.5 mm, off");
}

TEST(Advise, PutsBackThePartThatMovedMostWhereTogetherTheyGoTooFar) {
  FakeBench bench;
  bench.result = [](const Configuration& c) {
    double value = first_order(c);
    for (const Part& part : c.without) value += part.name == "off" ? 0.014 : 0.01;
    return value;
  };
  // 0.05 + 0.024 is beyond 0.06; 0.05 + 0.01 is within it.
  const Advice advice = advise(cells, {plain}, {no_les, off}, 0.0601, bench);
  EXPECT_EQ(name_of(advice.chosen->configuration), "plain on 2.5 mm, no LES");
}

TEST(Advise, AFormThatDoesNotApplyIsNotTried) {
  FakeBench bench;
  bench.result = first_order;
  const Part lid{"lid", {}, Form::rigid_lid, ""};
  const Advice advice = advise(cells, {plain}, {lid}, 0.06, bench);
  EXPECT_TRUE(advice.chosen->configuration.without.empty());
}

}  // namespace
}  // namespace granvof::compare
