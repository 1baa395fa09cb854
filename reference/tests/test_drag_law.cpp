// Drag of one bead by the closure that the continuum and demvof share.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/tests/printed_drag.hpp"
#include "solver/closures/drag/drag.hpp"

namespace {

constexpr granvof::Fluid water{1000.0, 1e-3}, air{1.0, 1e-5};
constexpr double d = 0.8e-3;

double by_closure(granvof::closures::DragLaw law, double f_s, double alpha, double slip) {
  return law.with(
      [&](auto drag) { return granvof::closures::drag_on_grain(drag, f_s, alpha, slip, air, water, d); });
}

}  // namespace

TEST(DragLaw, StokesForASlowLoneBead) {
  EXPECT_NEAR(by_closure(granvof::closures::DragLaw::of<granvof::closures::DragPaper>(), 0.0, 1.0, 1e-9),
              3.0 * std::numbers::pi * water.viscosity * d, 1e-11);
}

TEST(DragLaw, ErgunsViscousTermInAPackedBed) {
  const double f_s = 0.6, volume = std::numbers::pi / 6.0 * d * d * d;
  const double beta = 150.0 * f_s * f_s * 1e-3 / (0.4 * d * d);
  EXPECT_NEAR(by_closure(granvof::closures::DragLaw::of<granvof::closures::DragPaper>(), f_s, 1.0, 0.0),
              beta * volume / f_s, 1e-9 * beta * volume);
}

// Two independent writings of eqs (8) and (9) must mean the same.
TEST(DragLaw, OfThePaperIsThePrintedOne) {
  const demvof::test::PhaseProperties gas{air.density, air.viscosity}, liquid{water.density, water.viscosity};
  for (const double f_s : {0.0, 0.01, 0.15, 0.19, 0.2, 0.21, 0.3, 0.6}) {
    for (const double slip : {0.0, 1e-3, 0.1, 2.0}) {
      for (const double alpha : {0.0, 0.3, 1.0}) {
        const double printed = demvof::test::bead_drag(f_s, alpha, slip, gas, liquid, d);
        EXPECT_NEAR(
            by_closure(granvof::closures::DragLaw::of<granvof::closures::DragPaper>(), f_s, alpha, slip),
            printed, 1e-9 * printed)
            << f_s << ' ' << slip << ' ' << alpha;
      }
    }
  }
}
