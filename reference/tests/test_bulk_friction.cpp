// mu(I) of the beads: the fit, and a small chute.
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reference/demvof/bulk_friction/chute.hpp"
#include "reference/demvof/bulk_friction/friction_law.hpp"

namespace {

std::vector<demvof::FrictionPoint> points_of(const demvof::FrictionLaw& law, double scatter) {
  std::vector<demvof::FrictionPoint> points;
  for (int n = 0; n < 20; ++n) {
    const double inertia = 0.02 * std::pow(1.18, n);
    points.push_back({inertia, law(inertia) + (n % 2 == 0 ? scatter : -scatter)});
  }
  return points;
}

}  // namespace

TEST(FrictionLaw, TheFitFindsTheLawThatMadeThePoints) {
  const demvof::FrictionLaw law{0.36, 0.65, 0.3};
  const demvof::FrictionFit fit = demvof::fit_friction(points_of(law, 0.0));
  EXPECT_NEAR(fit.law.at_rest, law.at_rest, 1e-4);
  EXPECT_NEAR(fit.law.limit, law.limit, 1e-3);
  EXPECT_NEAR(fit.law.scale, law.scale, 1e-3);
  EXPECT_LT(fit.rms, 1e-5);
}

TEST(FrictionLaw, ScatterWidensTheBandsAndStaysWithinThem) {
  const demvof::FrictionLaw law{0.36, 0.65, 0.3};
  const demvof::FrictionFit fit = demvof::fit_friction(points_of(law, 0.005));
  EXPECT_GT(fit.band.at_rest, 1e-3);
  EXPECT_NEAR(fit.law.at_rest, law.at_rest, fit.band.at_rest);
  EXPECT_NEAR(fit.law.limit, law.limit, fit.band.limit);
  EXPECT_NEAR(fit.rms, 0.005, 0.001);
}

TEST(FrictionLaw, ThreePointsAreRefused) {
  EXPECT_THROW(demvof::fit_friction({{0.1, 0.4}, {0.2, 0.45}, {0.3, 0.5}}), std::invalid_argument);
}

// Steep enough to flow, then level: points come from the flow alone, their friction lies between that of the
// last slope and a little above that of the first, and on the level the beads come to rest.
TEST(Chute, FlowsOnASteepSlopeAndStopsOnTheLevel) {
  demvof::ChuteSettings s;
  s.diameter = 1e-3;
  s.density = 2500.0;
  s.length = s.depth = 6.0;
  s.layer = 10.0;
  s.slopes = {25.0, 5.0, 0.0};
  s.stage_time = 0.18;
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  const demvof::ChuteResult result = demvof::run_chute(s);
  ASSERT_TRUE(result.lowest_flow.has_value());
  ASSERT_TRUE(result.stopped_at.has_value());
  EXPECT_LT(*result.stopped_at, 15.0);
  ASSERT_GE(result.points.size(), 4U);
  for (const demvof::ChutePoint& p : result.points) {
    if (p.slope < 20.0) continue;
    EXPECT_GT(p.friction.friction, 0.25);
    EXPECT_LT(p.friction.friction, 0.75);
    EXPECT_GT(p.friction.inertial_number, 0.05);
    EXPECT_GT(p.solid_fraction, 0.45);
    EXPECT_LT(p.solid_fraction, 0.62);
  }
}
