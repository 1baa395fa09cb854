// From a case to the settings of the two sides.
#include <algorithm>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "reference/demvof/program/scene_setup.hpp"
#include "reference/tests/small_case.hpp"

namespace {

using demvof::test::small;

constexpr double d = 0.8e-3;

std::string refusal(const std::vector<std::string>& overrides) {
  return granvof::test::refusal([&] { demvof::check_scene(small(overrides)); });
}

double highest(const std::vector<double>& position) {
  double y = 0.0;
  for (std::size_t n = 1; n < position.size(); n += 3) y = std::max(y, position[n]);
  return y;
}

}  // namespace

TEST(SceneSetup, BeadsAreTheGrains) {
  const demvof::BeadSettings beads = demvof::bead_settings(small(), "scratch");
  EXPECT_DOUBLE_EQ(beads.diameter, d);
  EXPECT_DOUBLE_EQ(beads.dt, 1e-5);
}

TEST(SceneSetup, TheGatesPlateIsAsTheWallsUnlessSaidOtherwise) {
  const auto law = [](const std::vector<std::string>& more) {
    std::vector<std::string> overrides{"gate={position=0.01, speed=1}"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return demvof::bead_settings(small(overrides), "scratch").law;
  };
  EXPECT_EQ(law({"reference.wall_friction=0.3"}).gate_friction, 0.3);
  const demvof::ContactLaw smooth = law({"reference.gate_friction=0"});
  EXPECT_EQ(smooth.gate_friction, 0.0);
  EXPECT_EQ(smooth.wall_friction, 0.4);
  const char* slip = R"(walls={left="slip", right="slip", bottom="slip", top="open"})";
  EXPECT_EQ(law({slip}).gate_friction, 0.0);
}

TEST(SceneSetup, MomentumIsCarriedUpwindUnlessSaidOtherwise) {
  const auto scheme = [](const std::vector<std::string>& more) {
    return demvof::fluid_settings(small(more), "scratch").convection;
  };
  EXPECT_EQ(scheme({}), demvof::MomentumConvection::upwind);
  EXPECT_EQ(scheme({"reference.convection=van-leer"}), demvof::MomentumConvection::van_leer);
}

// Size and step follow the factor, the material does not.
TEST(SceneSetup, CoarseGrainedBeadsAreLargerAndOfTheSameMaterial) {
  const granvof::Scene scene = small({"reference.coarse_graining=1.5"});
  const demvof::BeadSettings grain = demvof::bead_settings(small(), "scratch");
  const demvof::BeadSettings bead = demvof::bead_settings(scene, "scratch");
  EXPECT_DOUBLE_EQ(bead.diameter, 1.5 * d);
  EXPECT_DOUBLE_EQ(bead.dt, 1.5e-5);
  EXPECT_EQ(bead.density, grain.density);
  EXPECT_EQ(bead.law.young, grain.law.young);
  EXPECT_EQ(bead.law.restitution, grain.law.restitution);
  EXPECT_EQ(bead.law.bead_friction, grain.law.bead_friction);

  const demvof::ColumnSettings column = demvof::column_settings(scene, 1, {}, "scratch");
  EXPECT_DOUBLE_EQ(column.diameter, 1.5 * d);
  EXPECT_DOUBLE_EQ(column.dt, 1.5e-5);
  EXPECT_EQ(column.packing, demvof::column_settings(small(), 1, {}, "scratch").packing);

  const auto floor = demvof::floor_beads(scene, 1), fine = demvof::floor_beads(small(), 1);
  EXPECT_NEAR(static_cast<double>(fine.size()) / static_cast<double>(floor.size()), 1.5 * 1.5, 0.1);
  EXPECT_GT(highest(floor), 0.2 * d);
  EXPECT_LE(highest(floor), 0.2 * 1.5 * d);
}

TEST(SceneSetup, ASliceThinnerThanTwoBeadsIsRefused) {
  EXPECT_EQ(refusal({"reference.coarse_graining=2.5"}), "");
  const std::string why = refusal({"reference.coarse_graining=2.6"});
  EXPECT_NE(why.find("reference.slice_depth is 0.004 m, allowed: >= 0.00416 m"), std::string::npos) << why;
}

TEST(SceneSetup, WhatOnlyTheContinuumHasIsRefused) {
  using Changes = std::vector<std::string>;
  for (const auto& [changes, what] :
       {std::pair{Changes{"walls.right.outflow_pressure=0"}, "a side is of kind outlet"},
        std::pair{Changes{"walls.left=periodic", "walls.right=periodic"}, "a side is of kind periodic"}})
    EXPECT_NE(refusal(changes).find(what), std::string::npos) << refusal(changes);
}

namespace {

const std::string step = "obstacle={x0=[0.015], x1=[0.02], y0=[0], y1=[0.005]}";

}  // namespace

TEST(SceneSetup, ObstaclesAreTheSameForBeadsAndFluid) {
  EXPECT_EQ(refusal({step}), "");
  const demvof::FluidSettings fluid = demvof::fluid_settings(small({step}), "scratch");
  const demvof::BeadSettings beads = demvof::bead_settings(small({step}), "scratch");
  ASSERT_EQ(fluid.obstacles.size(), 12U * 8U);
  for (std::size_t c = 0; c < fluid.obstacles.size(); ++c)
    EXPECT_EQ(fluid.obstacles[c], c / 12 < 2 && c % 12 >= 6 && c % 12 < 8 ? 1 : 0) << c;
  EXPECT_EQ(beads.obstacles.closed, fluid.obstacles);
  EXPECT_EQ(beads.obstacles.cells, fluid.cells);
  EXPECT_EQ(beads.obstacles.spacing, fluid.spacing);
  EXPECT_TRUE(demvof::bead_settings(small(), "scratch").obstacles.closed.empty());
  EXPECT_TRUE(demvof::fluid_settings(small(), "scratch").obstacles.empty());
}

// Grains stick to obstacles, also where they slip on the tank's walls.
TEST(SceneSetup, ObstaclesHaveTheFrictionOfWallsThatGrainsStickTo) {
  const char* slip = R"(walls={left="slip", right="slip", bottom="slip", top="open"})";
  const demvof::ContactLaw law = demvof::bead_settings(small({step, slip}), "scratch").law;
  EXPECT_EQ(law.wall_friction, 0.0);
  EXPECT_EQ(law.obstacle_friction, 0.4);
}

// Rough on top as the floor is, and none of its beads inside.
TEST(SceneSetup, ObstaclesAreRoughOnTop) {
  const std::vector<double> floor = demvof::floor_beads(small({step}), 1);
  int on_top = 0, below = 0;
  for (std::size_t n = 0; n < floor.size(); n += 3) {
    const double x = floor[n], y = floor[n + 1];
    const bool over = x >= 0.015 && x < 0.02;
    EXPECT_TRUE(over ? y >= 0.005 && y <= 0.005 + 0.2 * d : y <= 0.2 * d) << x << ' ' << y;
    ++(over ? on_top : below);
  }
  EXPECT_NEAR(on_top, 0.7 * 0.005 * 0.004 / (0.785 * d * d), 2.0);
  EXPECT_NEAR(below, 0.7 * 0.025 * 0.004 / (0.785 * d * d), 8.0);
  EXPECT_TRUE(demvof::floor_beads(small({step, "reference.floor=smooth"}), 1).empty());
  // A bed that stands on an obstacle stands on a floor.
  const std::vector<std::string> raised{"obstacle={x0=[0], x1=[0.0125], y0=[0], y1=[0.005]}", "bed.y=0.005"};
  EXPECT_EQ(refusal(raised), "");
  EXPECT_FALSE(demvof::floor_beads(small(raised), 1).empty());
}

TEST(SceneSetup, ObstaclesThatBeadsOrFluidCannotHaveAreRefused) {
  using Changes = std::vector<std::string>;
  for (const auto& [changes, what] :
       {std::pair{Changes{"obstacle={x0=[0.0225], x1=[0.03], y0=[0], y1=[0.005]}", "reference.cell=0.005"},
                  "an obstacle's face at x = 0.0225 m does not lie on one of the fluid cells; choose "
                  "reference.cell so that it does"},
        std::pair{Changes{"obstacle={x0=[0.015, 0.02], x1=[0.02, 0.025], y0=[0, 0.005], y1=[0.005, 0.01]}"},
                  "obstacles touch along an edge alone"},
        std::pair{Changes{"obstacle={x0=[0.02, 0.02], x1=[0.0225, 0.03], y0=[0, 0.01], y1=[0.01, 0.0125]}"},
                  "obstacles shut a part of the tank off"},
        // as long as the gate stands
        std::pair{Changes{"gate={position=0.01, speed=1}", "bed.x=0.0025", "bed.length=0.0075",
                          "obstacle={x0=[0.0], x1=[0.0025], y0=[0.0], y1=[0.005]}"},
                  ""}})
    EXPECT_TRUE(what[0] == 0 ? refusal(changes).empty() : refusal(changes).find(what) != std::string::npos)
        << refusal(changes);
}

TEST(SceneSetup, AnInclinedTankIsInclinedForBoth) {
  EXPECT_EQ(refusal({"tank.inclination=12"}), "");
  EXPECT_EQ(demvof::fluid_settings(small({"tank.inclination=12"}), "scratch").inclination, 12.0);
  EXPECT_EQ(demvof::bead_settings(small({"tank.inclination=12"}), "scratch").inclination, 12.0);
}

TEST(SceneSetup, BeadsLargerThanTheCellsAreRefused) {
  EXPECT_EQ(refusal({"reference.coarse_graining=3", "reference.slice_depth=0.01"}), "");
  const std::string why = refusal({"reference.coarse_graining=3.2", "reference.slice_depth=0.01"});
  EXPECT_NE(why.find("beads of 0.00256 m are larger than the fluid's cells"), std::string::npos) << why;
}

TEST(SceneSetup, ABedThatCannotBePackedIsRefused) {
  EXPECT_EQ(refusal({"reference.packing=0.64"}), "");
  const std::string why = refusal({"reference.packing=0.99"});
  EXPECT_NE(why.find("reference.packing is 0.99, a bed that cannot be packed"), std::string::npos) << why;
}

// What would end LIGGGHTS, or never end, is refused before anything is written.
TEST(SceneSetup, WhatTheBeadsCannotBeIsRefused) {
  for (const auto& [given, why] : std::vector<std::pair<std::string, std::string>>{
           {"reference.young=1e25", "reference.young is 1e+25, allowed: <= 1e+09 Pa"},
           {"reference.bead_restitution=0.05", "reference.bead_restitution is 0.05, allowed: > 0.05"},
           {"reference.fluid_dt=1e20", "reference.fluid_dt is 1e+20 s, allowed: at most"},
           {"reference.hold=1e6", "reference.hold and time.end are 1e+06 s, allowed: at most"},
           {"reference.packing=1e-9", "the bed holds 8.95e-07 beads"}}) {
    EXPECT_NE(refusal({given}).find(why), std::string::npos) << given << ": " << refusal({given});
  }
}

TEST(SceneSetup, MoreBeadsThanCanBeComputedAreRefused) {
  const std::string why = refusal({"solid.diameter=1e-9"});
  EXPECT_NE(why.find("beads of 1e-09 m"), std::string::npos) << why;
  EXPECT_NE(why.find("at most 1e+07 beads"), std::string::npos) << why;
}

TEST(SceneSetup, WithoutLiquidNoCellHasAny) {
  const granvof::Scene scene = small({"liquid=false"});
  EXPECT_EQ(refusal({"liquid=false"}), "");
  const auto alpha = demvof::initial_alpha(scene, demvof::fluid_settings(scene, "scratch"));
  EXPECT_EQ(alpha, std::vector<double>(12 * 8, 0.0));
}
