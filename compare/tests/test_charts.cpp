// What a chart of error against cost advises.
#include <gtest/gtest.h>

#include "compare/study/charts.hpp"

namespace granvof::compare {
namespace {

ChartPoint point(const char* method, double cell, double cost, const char* failure = "") {
  ChartPoint made;
  made.method = method;
  made.cell = cell;
  made.cost = cost;
  made.failure = failure;
  return made;
}

// One panel with these errors, against a reference of this uncertainty.
ChartResult chart(std::vector<ChartPoint> points, std::vector<std::optional<double>> errors,
                  double floor = 0.0) {
  ChartResult result;
  result.chart.case_name = "s1";
  result.points = std::move(points);
  PanelResult panel;
  panel.panel.quantity.name = "run_out";
  panel.target.observed.value = 1.0;
  panel.target.floor = floor;
  panel.errors = std::move(errors);
  result.panels.push_back(std::move(panel));
  result.dem_cost = 1000.0;
  return result;
}

std::string line(const ChartResult& result) {
  return recommendations(result).at(0);
}

TEST(Charts, NamesTheCheapestPointWithinEachTolerance) {
  const std::string said =
      line(chart({point("first", 0.005, 1.0), point("first", 0.0025, 10.0)}, {0.09, 0.04}));
  EXPECT_NE(said.find("for 10 % use first on 5 mm"), std::string::npos) << said;
  EXPECT_NE(said.find("DEM-VOF costs 1000 times that"), std::string::npos) << said;
  EXPECT_NE(said.find("for 5 % use first on 2.5 mm"), std::string::npos) << said;
  EXPECT_NE(said.find("for 2 % none of these is enough"), std::string::npos) << said;
}

TEST(Charts, DoesNotNameWhatAFinerGridTakesBack) {
  const std::string said =
      line(chart({point("lucky", 0.005, 1.0), point("lucky", 0.0025, 8.0), point("first", 0.0025, 9.0)},
                 {0.01, 0.07, 0.04}));
  EXPECT_NE(said.find("for 10 % use lucky on 5 mm"), std::string::npos) << said;
  EXPECT_NE(said.find("for 5 % use first on 2.5 mm"), std::string::npos) << said;
}

TEST(Charts, DoesNotNameAMethodThatFailsOnAFinerGrid) {
  const std::string said =
      line(chart({point("first", 0.005, 1.0), point("first", 0.0025, 8.0, "blow-up")}, {0.01, std::nullopt}));
  EXPECT_NE(said.find("for 10 % none of these is enough"), std::string::npos) << said;
}

TEST(Charts, TellsNothingBelowTheUncertaintyOfTheReference) {
  const std::string said = line(chart({point("first", 0.005, 1.0)}, {0.01}, 0.06));
  EXPECT_NE(said.find("for 10 % use first"), std::string::npos) << said;
  EXPECT_NE(said.find("for 5 % nothing can be told (the reference itself is uncertain by 6 %)"),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace granvof::compare
