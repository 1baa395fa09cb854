#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/demvof/coupling/drag_law.hpp"
#include "solver/closures/drag.hpp"

namespace {

constexpr demvof::PhaseProperties water{1000.0, 1e-3};
constexpr demvof::PhaseProperties air{1.0, 1e-5};
constexpr double d = 0.8e-3;

}  // namespace

TEST(DragLaw, StokesForASlowLoneBead) {
  EXPECT_NEAR(demvof::bead_drag(0.0, 1e-9, water, d), 3.0 * std::numbers::pi * water.viscosity * d, 1e-11);
}

TEST(DragLaw, ErgunsViscousTermInAPackedBed) {
  const double f_s = 0.6, volume = std::numbers::pi / 6.0 * d * d * d;
  const double beta = 150.0 * f_s * f_s * 1e-3 / (0.4 * d * d);
  EXPECT_NEAR(demvof::bead_drag(f_s, 0.0, water, d), beta * volume / f_s, 1e-9 * beta * volume);
}

// Two independent writings of eqs (8) and (9) must mean the same.
TEST(DragLaw, AgreesWithTheContinuumsClosure) {
  const granvof::Fluid gas{1.0, 1e-5}, liquid{1000.0, 1e-3};
  const double volume = std::numbers::pi / 6.0 * d * d * d;
  for (const double f_s : {0.01, 0.15, 0.19, 0.2, 0.21, 0.3, 0.6}) {
    for (const double slip : {0.0, 1e-3, 0.1, 2.0}) {
      for (const double alpha : {0.0, 0.3, 1.0}) {
        const double continuum =
            granvof::closures::drag_coefficient(f_s, alpha, slip, gas, liquid, d) / f_s * volume;
        EXPECT_NEAR(demvof::bead_drag(f_s, alpha, slip, air, water, d), continuum, 1e-9 * continuum)
            << f_s << ' ' << slip << ' ' << alpha;
      }
    }
  }
}
