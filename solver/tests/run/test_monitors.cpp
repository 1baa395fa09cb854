// The monitors account for what leaves through the sides.
#include <gtest/gtest.h>

#include "solver/run/initial_state.hpp"
#include "solver/run/monitors.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

// A tank full of liquid, half of it a bed, from which a tenth of the grains is taken: liquid is in their
// place.
class TenthLeft : public ::testing::Test {
 protected:
  static Scene scene() {
    Scene scene = test::box_scene(2, {4, 8, 1}, {0.04, 0.08, 1.0});
    scene.liquid_boxes = {Box{{0.0, 0.0, 0.0}, {0.04, 0.08, 1.0}}};
    scene.bed = Bed{.box = {{0.0, 0.0, 0.0}, {0.04, 0.04, 1.0}}, .solid_fraction = 0.6};
    return scene;
  }
  TenthLeft() {
    const double solid = monitors_.solid_volume(state_);
    EXPECT_NEAR(solid, 0.6 * 0.04 * 0.04, 1e-15);
    tenth_ = 0.1 * solid;
    const auto& cells = tank_.grid.cells;
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 4; ++i) state_.f_s[cells.index(i, j, 0)] *= 0.9;
  }
  test::Tank tank_{scene()};
  State state_ = initial_state(tank_.grid, tank_.scene, tank_.boundary);
  Monitors monitors_{tank_.grid, tank_.scene, state_};
  double tenth_ = 0.0;  // [m3]
};

TEST_F(TenthLeft, ThroughASideIsNoError) {
  monitors_.update(state_, -tenth_, tenth_);
  EXPECT_LT(monitors_.solid_volume_error(), 1e-12);
  EXPECT_LT(monitors_.liquid_volume_error(), 1e-12);
}

TEST_F(TenthLeft, UnseenIsAnError) {
  monitors_.update(state_, 0.0, 0.25 * tenth_);
  EXPECT_NEAR(monitors_.solid_volume_error(), 0.075, 1e-12);
  EXPECT_NEAR(monitors_.liquid_volume_error(), 0.1 * 0.6 * 0.5 / 0.7, 1e-12);
}

// Of a tank that was empty the shares are of what has come in.
TEST(EmptyAtFirst, WhatComesInIsHeldAgainstWhatIsThere) {
  const test::Tank tank{test::box_scene(2, {4, 8, 1}, {0.04, 0.08, 1.0})};
  State state = initial_state(tank.grid, tank.scene, tank.boundary);
  state.alpha.fill(0.0);
  Monitors monitors(tank.grid, tank.scene, state);
  EXPECT_EQ(monitors.solid_volume_error(), 0.0);
  for (int i = 0; i < 4; ++i) state.f_s[tank.grid.cells.index(i, 0, 0)] = 0.1;
  const double came = monitors.solid_volume(state);
  Monitors told = monitors;
  told.update(state, 0.0, -came);
  EXPECT_LT(told.solid_volume_error(), 1e-12);
  monitors.update(state, 0.0, -1.25 * came);
  EXPECT_NEAR(monitors.solid_volume_error(), 0.2, 1e-12);
}

}  // namespace
}  // namespace granvof
