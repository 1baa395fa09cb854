// Drag on the agitation of sheared grains.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/agitation_drag.hpp"

namespace granvof::closures {
namespace {

constexpr double rho_s = 2500.0, d_s = 0.8e-3, drag = 2e5, pressure = 200.0;

double coefficient(double rate) {
  return agitation_friction(drag, pressure, 0.5 * rate, rho_s, d_s);
}

TEST(AgitationDrag, TakesTheWorkOfItsStressFromTheAgitation) {
  // I = 20 * 8e-4 / sqrt(200 / 2500) = 0.0565685; dv^2 = (0.016)^2 / (9 * 0.0575685) = 4.94099e-4 m2/s2
  const double rate = 20.0, spent = coefficient(rate) * pressure * rate;  // [W/m3]
  EXPECT_NEAR(spent, drag * 4.94099e-4, 1e-4 * spent);
}

TEST(AgitationDrag, ABedAtRestIsNoStronger) {
  EXPECT_EQ(coefficient(0.0), 0.0);
  EXPECT_LT(coefficient(1e-4), 1e-4);
}

TEST(AgitationDrag, FastShearGivesACoefficientThatHangsOnTheLoadAlone) {
  const double limit = drag * d_s / (9.0 * std::sqrt(rho_s * pressure));
  EXPECT_NEAR(coefficient(1e4), limit, 1e-3 * limit);
  double previous = 0.0;
  for (double rate = 1e-6; rate < 1e6; rate *= 3.0) {
    EXPECT_GT(coefficient(rate), previous) << rate;
    EXPECT_LT(coefficient(rate), limit) << rate;
    previous = coefficient(rate);
  }
}

TEST(AgitationDrag, TakesNoMoreThanTheAgitationHas) {
  const double f_s = 0.57;
  EXPECT_EQ(agitated_drag(1e3, f_s, pressure, rho_s, d_s), 1e3);
  for (const double p : {1e-3, 1.0, 1e3}) {
    const double most = agitated_drag(1e12, f_s, p, rho_s, d_s);
    EXPECT_NEAR(agitation_friction(most, p, 1e9, rho_s, d_s), f_s / 9.0, 1e-6);
    // per volume f_s rho_s dv^2 a rearrangement time d_s sqrt(rho_s / p)
    EXPECT_NEAR(most, f_s * rho_s / (d_s * std::sqrt(rho_s / p)), 1e-9 * most);
  }
  EXPECT_EQ(agitated_drag(1e3, f_s, 0.0, rho_s, d_s), 0.0);
}

TEST(AgitationDrag, VanishesWithTheDrag) {
  EXPECT_EQ(agitation_friction(0.0, pressure, 10.0, rho_s, d_s), 0.0);
}

}  // namespace
}  // namespace granvof::closures
