// Slopes within a cell: bounds that no new extremum passes, symmetry, and second order where f is smooth.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/slope_limiter/laws.hpp"

namespace granvof::closures {
namespace {

template <typename Body>
void for_each_limiter(Body&& body) {
  for (std::size_t place = 0; place < SlopeLimiters::facts.size(); ++place)
    SlopeLimiter(place).with([&](auto limiter) {
      SCOPED_TRACE(limiter.facts.word);
      body(limiter);
    });
}

TEST(SlopeLimiter, Values) {
  EXPECT_EQ(LimiterNone::slope(1.0, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(LimiterVanLeer::slope(1.0, 3.0), 1.5);  // 2 a b / (a + b)
  EXPECT_DOUBLE_EQ(LimiterSuperbee::slope(1.0, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(LimiterSuperbee::slope(1.0, 1.5), 1.5);
  EXPECT_DOUBLE_EQ(LimiterSuperbee::slope(-1.0, -3.0), -2.0);
}

TEST(SlopeLimiter, MakesNoNewExtremum) {
  for_each_limiter([](auto limiter) {
    for (const double a : {-2.0, -0.3, 0.0, 1e-300, 0.4, 5.0})
      for (const double b : {-1.0, -0.1, 0.0, 0.2, 3.0}) {
        const double slope = limiter.slope(a, b);
        EXPECT_EQ(slope, limiter.slope(b, a));
        if (a * b <= 0.0) {
          EXPECT_EQ(slope, 0.0);
        } else {  // half of it reaches neither neighbour: Sweby's region
          EXPECT_GE(slope * a, 0.0);
          EXPECT_LE(std::fabs(slope), 2.0 * std::min(std::fabs(a), std::fabs(b)) * (1.0 + 1e-15));
        }
      }
  });
}

TEST(SlopeLimiter, IsTheSlopeOfALineWhereItSaysSecondOrder) {
  for_each_limiter(
      [](auto limiter) { EXPECT_EQ(limiter.slope(0.7, 0.7), limiter.second_order ? 0.7 : 0.0); });
  EXPECT_FALSE(is_of_second_order(SlopeLimiter()));
}

}  // namespace
}  // namespace granvof::closures
