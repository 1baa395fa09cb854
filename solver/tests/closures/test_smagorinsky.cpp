// Sub-grid viscosity, eq (10).
#include <gtest/gtest.h>

#include "solver/closures/smagorinsky.hpp"

namespace granvof::closures {
namespace {

TEST(Smagorinsky, SimpleShear) {
  // du/dy = G: Smagorinsky's law is rho (C_s Delta)^2 G. Here S_xy = S_yx = G/2, so S:S = G^2/2.
  const double rate = 40.0;
  EXPECT_NEAR(eddy_viscosity(1000.0, 2.5e-3, 0.5 * rate * rate),
              1000.0 * 0.18 * 0.18 * 2.5e-3 * 2.5e-3 * 40.0, 1e-12);
}

TEST(Smagorinsky, PureStrainEqualsThePrintedFormWithTwiceTheStrain) {
  // u = E x, v = -E y: grad u + grad u^T = diag(2E, -2E), |S||S| = 8 E^2, sqrt(|S||S| / 2) = 2 E.
  const double rate = 3.0;
  EXPECT_NEAR(eddy_viscosity(1.0, 1.0, 2.0 * rate * rate), 0.0324 * 2.0 * rate, 1e-15);
}

TEST(Smagorinsky, LimitsAndScaling) {
  EXPECT_EQ(eddy_viscosity(1000.0, 1e-3, 0.0), 0.0);
  EXPECT_EQ(eddy_viscosity(1000.0, 0.0, 5.0), 0.0);
  const double base = eddy_viscosity(1000.0, 1e-3, 5.0);
  EXPECT_NEAR(eddy_viscosity(1000.0, 2e-3, 5.0), 4.0 * base, 1e-15);   // Delta^2
  EXPECT_NEAR(eddy_viscosity(1000.0, 1e-3, 20.0), 2.0 * base, 1e-15);  // |S|
  EXPECT_NEAR(eddy_viscosity(1.0, 1e-3, 5.0), 1e-3 * base, 1e-18);     // rho_c
}

}  // namespace
}  // namespace granvof::closures
