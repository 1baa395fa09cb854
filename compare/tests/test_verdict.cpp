#include <gtest/gtest.h>

#include "compare/checks/verdict.hpp"

namespace granvof::compare {
namespace {

Check within(double tolerance, bool relative = false) {
  Check check;
  check.tolerance = {tolerance, relative, "-"};
  return check;
}

TEST(Verdict, AgreesAtTheToleranceAndDiffersBeyond) {
  EXPECT_EQ(judge(1.5, 1.0, 0.0, within(0.5)).verdict, Verdict::agrees);
  const Judgement off = judge(2.0, 1.0, 0.0, within(0.25));
  EXPECT_EQ(off.verdict, Verdict::differs);
  EXPECT_TRUE(off.unexpected);
  EXPECT_DOUBLE_EQ(off.deviation, 1.0);
  EXPECT_DOUBLE_EQ(off.distance, 0.75);
}

TEST(Verdict, RelativeToleranceIsOfTheReference) {
  EXPECT_EQ(judge(-9.0, -10.0, 0.0, within(0.1, true)).verdict, Verdict::agrees);
  EXPECT_EQ(judge(-8.9, -10.0, 0.0, within(0.1, true)).verdict, Verdict::differs);
}

TEST(Verdict, TheBandOfTheReferenceCountsAlone) {
  // Tolerance and band are not added: a value must lie inside one of the two.
  EXPECT_EQ(judge(1.3, 1.0, 0.4, within(0.2)).verdict, Verdict::within_band);
  EXPECT_FALSE(judge(1.3, 1.0, 0.4, within(0.2)).unexpected);
  EXPECT_EQ(judge(1.5, 1.0, 0.4, within(0.2)).verdict, Verdict::differs);
  EXPECT_EQ(judge(1.1, 1.0, 0.4, within(0.2)).verdict, Verdict::agrees);
}

TEST(Verdict, OneSidedBounds) {
  Check bound = within(0.0);
  bound.relation = Relation::at_most;
  EXPECT_EQ(judge(0.629, 0.63, 0.0, bound).verdict, Verdict::agrees);
  EXPECT_EQ(judge(0.631, 0.63, 0.0, bound).verdict, Verdict::differs);
  bound.relation = Relation::at_least;
  EXPECT_EQ(judge(-1e-20, 0.0, 0.0, bound).verdict, Verdict::differs);
  EXPECT_EQ(judge(0.2, 0.0, 0.0, bound).verdict, Verdict::agrees);
}

TEST(Verdict, ADeclaredFailureIsExpectedUntilItPassesOrWorsens) {
  Check known = within(0.1);
  known.expected_failure = {"known cause", 0.3, ""};
  const Judgement as_declared = judge(1.3, 1.0, 0.0, known);
  EXPECT_EQ(as_declared.verdict, Verdict::expected_failure);
  EXPECT_FALSE(as_declared.unexpected);
  const Judgement passes = judge(1.05, 1.0, 0.0, known);
  EXPECT_EQ(passes.verdict, Verdict::agrees);
  EXPECT_TRUE(passes.unexpected);
  const Judgement worse = judge(1.5, 1.0, 0.0, known);
  EXPECT_EQ(worse.verdict, Verdict::differs);
  EXPECT_TRUE(worse.unexpected);
}

TEST(Verdict, WhatIsOnlyReportedIsNeverUnexpected) {
  Check reported = within(0.1);
  reported.asserted = false;
  const Judgement off = judge(2.0, 1.0, 0.0, reported);
  EXPECT_EQ(off.verdict, Verdict::reported);
  EXPECT_EQ(name_of(off.verdict), "reported only");
  EXPECT_FALSE(off.unexpected);
  EXPECT_EQ(judge(1.05, 1.0, 0.0, reported).verdict, Verdict::agrees);
}

}  // namespace
}  // namespace granvof::compare
