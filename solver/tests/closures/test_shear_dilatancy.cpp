// Packing under slow shear, and the contact laws that move with it.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/shear_dilatancy.hpp"

namespace granvof::closures {
namespace {

const Contact beads;
const double f_c = beads.critical_solid_fraction;

TEST(ShearDilatancy, DenseDilatesAndLooseCompacts) {
  EXPECT_NEAR(dilatancy_tangent(0.61, beads), 4.09 * 0.028, 1e-12);
  EXPECT_LT(dilatancy_tangent(0.57, beads), 0.0);
  EXPECT_EQ(dilatancy_tangent(f_c, beads), 0.0);
  double dense = 0.62, loose = 0.57;
  for (double gamma = 0.1; gamma < 3.0; gamma += 0.1) {
    const double d = sheared_packing(0.62, gamma, beads), l = sheared_packing(0.57, gamma, beads);
    EXPECT_LT(d, dense);
    EXPECT_GT(d, f_c);
    EXPECT_GT(l, loose);
    EXPECT_LT(l, f_c);
    dense = d;
    loose = l;
  }
}

TEST(ShearDilatancy, Limits) {
  for (const double f : {0.57, f_c, 0.61, 0.63}) {
    EXPECT_DOUBLE_EQ(sheared_packing(f, 0.0, beads), f);
    EXPECT_NEAR(sheared_packing(f, 100.0, beads), f_c, 1e-15);
  }
}

// d f_p / d gamma = -f_p tan(psi), at every strain; steps add up.
TEST(ShearDilatancy, SolvesItsEquation) {
  for (const double f : {0.571, 0.61}) {
    for (const double gamma : {0.0, 0.2, 1.0}) {
      const double step = 1e-5, here = sheared_packing(f, gamma, beads);
      const double slope = (sheared_packing(f, gamma + step, beads) - here) / step;
      EXPECT_NEAR(slope, -here * dilatancy_tangent(here, beads), 1e-5) << f << " " << gamma;
      EXPECT_NEAR(sheared_packing(here, 0.3, beads), sheared_packing(f, gamma + 0.3, beads), 1e-14);
    }
  }
}

// (13) and (15) per solid fraction are the same functions of f_s - f_p.
TEST(ShearDilatancy, ContactLawsMoveWithThePacking) {
  const double theta = 1e-3, e = 0.9, rho_s = 2500.0, moved = 0.03;
  for (const double excess : {0.002, 0.02, 0.05}) {
    const double f = beads.solid_fraction_min + excess;
    EXPECT_NEAR(elastic_pressure(f + moved, beads, 0.60).value / (f + moved),
                elastic_pressure(f, beads).value / f, 1e-9 * elastic_pressure(f, beads).value);
  }
  EXPECT_EQ(elastic_pressure(0.599, beads, 0.60).value, 0.0);
  const double power = 2.0 / beads.flow_law_exponent;
  const auto per_fractions = [&](double f, double packing) {
    const double f_s0 = beads.dense_solid_fraction + packing - beads.solid_fraction_min;
    return dense_pressure(f, theta, e, rho_s, beads, packing).value / std::pow(f * f_s0, power);
  };
  EXPECT_NEAR(per_fractions(0.60, 0.60) / per_fractions(0.57, 0.57), 1.0, 1e-12);
  EXPECT_LT(dense_pressure(0.60, theta, e, rho_s, beads, 0.60).value,
            dense_pressure(0.60, theta, e, rho_s, beads).value);  // not at its singularity any more
}

TEST(ShearDilatancy, PackingThatBearsALoad) {
  for (const double f : {0.571, 0.59, 0.61}) {
    EXPECT_NEAR(packing_that_bears(0.0, f, beads), f, 1e-9);
    for (const double load : {1.0, 400.0}) {
      const double packing = packing_that_bears(load, f, beads);
      const double borne = elastic_pressure(f, beads, packing).value;
      if (packing > beads.solid_fraction_min) {
        EXPECT_NEAR(borne, load, 1e-4) << f;
      }
      EXPECT_LE(borne, load * (1.0 + 1e-6)) << f;
    }
  }
  EXPECT_NEAR(packing_that_bears(1e9, 0.59, beads), beads.solid_fraction_min,
              1e-11);  // more than it can bear
}

}  // namespace
}  // namespace granvof::closures
