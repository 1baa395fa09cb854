#include <stdexcept>

#include <gtest/gtest.h>

#include "compare/study/pareto.hpp"
#include "compare/study/quantity.hpp"

namespace granvof::compare {
namespace {

TEST(Quantity, TakesMissingParametersFromTheTableOfChecks) {
  Check row;
  row.metric = "decay_rate";
  row.parameters.window = Window{0.4, 6.0};
  const std::vector<Check> rows{row};
  const Quantity found = parse_quantity("decay_rate", std::nullopt, rows);
  EXPECT_FALSE(found.is_curve);
  EXPECT_DOUBLE_EQ(found.parameters.window->begin, 0.4);
  EXPECT_THROW(parse_quantity("decay_rate", std::nullopt, {}), std::invalid_argument);
  EXPECT_TRUE(parse_quantity("run_out", std::nullopt).is_curve);
  EXPECT_FALSE(parse_quantity("run_out@10", std::nullopt).is_curve);
}

Observed curve_of(std::vector<double> y) {
  Observed observed;
  for (std::size_t i = 0; i < y.size(); ++i) observed.curve.time.push_back(static_cast<double>(i));
  observed.curve.value = std::move(y);
  return observed;
}

TEST(Quantity, DistanceOfCurvesIsTheRmsOverTheRangeOfTheReference) {
  const Quantity curve = parse_quantity("run_out", std::nullopt);
  EXPECT_NEAR(*relative_distance(curve, curve_of({0.4, 2.4, 4.4}), curve_of({0, 2, 4})), 0.1, 1e-12);
  // The common part of the abscissa; an offset of the whole reference changes nothing.
  EXPECT_NEAR(*relative_distance(curve, curve_of({100.4, 102.4}), curve_of({100, 102, 104})), 0.2, 1e-12);
  EXPECT_FALSE(relative_distance(curve, curve_of({1, 2}), curve_of({3, 3})));
  EXPECT_FALSE(relative_distance(curve, curve_of({1, 2}), Observed{}));
  const Quantity early = parse_quantity("run_out", Window{0, 1});
  EXPECT_NEAR(*relative_distance(early, curve_of({1, 3, 99}), curve_of({0, 2, 4})), 0.5, 1e-12);
  const Quantity beyond = parse_quantity("run_out", Window{0, 5});
  EXPECT_FALSE(relative_distance(beyond, curve_of({1, 3, 99}), curve_of({0, 2, 4})));
}

TEST(Quantity, DistanceOfValuesIsRelative) {
  const Quantity value = parse_quantity("run_out@10", std::nullopt);
  Observed a, b;
  a.value = 1.9;
  b.value = -2.0;
  EXPECT_NEAR(*relative_distance(value, a, b), 1.95, 1e-12);
  b.value = 0.0;
  EXPECT_FALSE(relative_distance(value, a, b));
}

TEST(Pareto, KeepsWhatNothingBeats) {
  const std::vector<WorkPrecision> points{{10, 0.1},           {1, 0.5}, {5, 0.2}, {6, 0.3}, {5, 0.2},
                                          {0.5, std::nullopt}, {20, 0.1}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(pareto_front({}).empty());
  EXPECT_TRUE(pareto_front({{1, std::nullopt}}).empty());
}

TEST(Pareto, CheapestWithinATolerance) {
  const std::vector<WorkPrecision> points{{10, 0.01}, {1, 0.5}, {5, 0.05}, {0.1, std::nullopt}};
  EXPECT_EQ(cheapest_within(points, 0.05), 2u);
  EXPECT_EQ(cheapest_within(points, 0.02), 0u);
  EXPECT_FALSE(cheapest_within(points, 0.001));
}

}  // namespace
}  // namespace granvof::compare
