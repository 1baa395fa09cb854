// What a case becomes: values, defaults, units, overrides, resolved text and hashes.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/scene/load_scene.hpp"
#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

TEST(LoadScene, ReadsGeometryAndMaterials) {
  const Scene scene = small();
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.title, "small");
  EXPECT_EQ(scene.tank, (Vec3{0.4, 0.12, 1.0}));
  EXPECT_EQ(scene.grid.cells, (std::array<int, 3>{40, 12, 1}));
  EXPECT_DOUBLE_EQ(scene.grid.spacing[0], 0.01);
  EXPECT_DOUBLE_EQ(scene.grid.spacing[2], 1.0);
  EXPECT_EQ(scene.liquid_boxes, (std::vector<Box>{{{0, 0, 0}, {0.4, 0.07, 1.0}}}));
  ASSERT_TRUE(scene.bed);
  EXPECT_EQ(scene.bed->box, (Box{{0, 0, 0}, {0.1, 0.05, 1.0}}));
  ASSERT_TRUE(scene.gate);
  EXPECT_EQ(*scene.gate, (Gate{0.1, 1.0}));
  EXPECT_EQ(scene.contact, Contact{});
  EXPECT_EQ(scene.model, Model{});
  Numerics numerics;  // but for the steps: shares of the scene's time
  numerics.dt_max = scene.numerics.dt_max;
  numerics.dt_min = scene.numerics.dt_min;
  EXPECT_EQ(scene.numerics, numerics);
}

TEST(LoadScene, AGateMayStandOnASeam) {
  const std::vector<std::string> joined{"walls.left=periodic", "walls.right=periodic"};
  for (const double x : {0.399, 0.4}) {
    auto overrides = joined;
    overrides.push_back(fmt::format("gate.position={}", x));
    EXPECT_EQ(small(overrides).gate->position, x);
  }
  auto outside = joined;
  outside.push_back("gate.position=0.401");
  EXPECT_NE(
      refusal([&] { small(outside); }).find("gate.position: got 0.401, allowed: inside the tank, at most"),
      std::string::npos);
}

TEST(LoadScene, CountsTimesInColumnUnits) {
  const Scene scene = small();
  const double unit = std::sqrt(0.05 / 9.81);
  EXPECT_DOUBLE_EQ(scene.times.unit, unit);
  EXPECT_DOUBLE_EQ(scene.times.end, 10 * unit);
  ASSERT_EQ(scene.times.row_times.size(), 201U);  // time.end / 200
  for (int k = 0; k < 201; ++k)
    EXPECT_DOUBLE_EQ(scene.times.row_times[static_cast<std::size_t>(k)], 0.05 * unit * k);
  EXPECT_EQ(scene.times.field_times, (std::vector<double>{0.0, unit, 5 * unit, 10 * unit}));
}

TEST(LoadScene, KeepsTheHoldInSeconds) {
  EXPECT_EQ(small({"time.hold=0.2"}).times.hold, 0.2);
}

TEST(LoadScene, SpacesFieldTimes) {
  EXPECT_EQ(small({"time.unit=s", "output.field_interval=4"}).times.field_times,
            (std::vector<double>{0, 4, 8, 10}));
}

// 3 * 0.1 is 0.30000000000000004, no time that anybody asked for.
TEST(LoadScene, TimesAreThoseThatAPersonWrites) {
  const auto tenths = small({"time.unit=s", "time.end=1", "output.series_interval=0.1"}).times.row_times;
  EXPECT_EQ(tenths, (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  const auto fine = small({"time.unit=s", "time.end=1", "output.series_interval=0.004"}).times.row_times;
  for (std::size_t k = 0; k < tenths.size(); ++k) EXPECT_EQ(fine[25 * k], tenths[k]) << k;
  const auto odd = small({"time.unit=s", "time.end=1", "output.series_interval=0.3"}).times.row_times;
  EXPECT_EQ(odd, (std::vector<double>{0, 0.3, 0.6, 0.9, 1}));
}

TEST(LoadScene, DropsFieldTimesBeyondAnEndBroughtForward) {
  EXPECT_EQ(small({"time.unit=s", "time.end=3"}).times.field_times, (std::vector<double>{0, 1, 3}));
}

TEST(LoadScene, PlacesTheBed) {
  EXPECT_EQ(small({"bed.y=on-water"}).bed->box.lower[1], 0.07);
  EXPECT_EQ(small({"bed.y=0.01"}).bed->box.lower[1], 0.01);
  const Scene floating = small({"bed.y=floating", "solid.density=600"});
  EXPECT_DOUBLE_EQ(floating.bed->box.lower[1], 0.07 - 0.6 * 0.05);
}

// 0.1 m x 1 m x 0.57 of grains a metre of height.
TEST(LoadScene, ABedOfAGivenVolumeOfSolidIsAsHighAsThatFills) {
  const Scene scene = small({"bed.solid_volume=0.002565"});
  EXPECT_DOUBLE_EQ(scene.bed->box.upper[1], 0.045);
  EXPECT_EQ(scene.bed->nominal_height, 0.05);
  EXPECT_EQ(scene.times.unit, small().times.unit);
  EXPECT_EQ(small().bed->nominal_height, 0.05);
  EXPECT_EQ(small({"bed.solid_volume=0.00285"}).bed->box, small().bed->box);  // all that the box holds
  EXPECT_DOUBLE_EQ(
      small({"bed.solid_volume=0.002565", "bed.y=floating", "solid.density=600"}).bed->box.lower[1],
      0.07 - 0.6 * 0.045);
  EXPECT_EQ(refusal([] { small({"bed.solid_volume=0.0029"}); }),
            "--set: bed.solid_volume: got 0.0029, allowed: at most 0.00285 m3, what the bed holds at "
            "bed.solid_fraction");
  EXPECT_NE(refusal([] {
              small({"bed.solid_volume=0.002", "bed.slope=60"});
            }).find("upright front face"),
            std::string::npos);
}

TEST(LoadScene, ReadsWalls) {
  const Scene scene = small({"walls.all=slip", "walls.left=no-slip",
                             "walls.bottom={solid=\"coulomb\", solid_friction=0.2, velocity=[0.1, 0]}"});
  EXPECT_EQ(scene.sides[left].fluid.kind, WallKind::no_slip);
  EXPECT_EQ(scene.sides[left].solid.kind, WallKind::no_slip);
  EXPECT_EQ(scene.sides[right].fluid.kind, WallKind::slip);
  EXPECT_EQ(scene.sides[right].solid.kind, WallKind::slip);
  EXPECT_EQ(scene.sides[bottom].fluid.kind, WallKind::slip) << "walls.all holds for what a side leaves open";
  EXPECT_EQ(scene.sides[bottom].solid, (PhaseWall{WallKind::coulomb, 0.2}));
  EXPECT_EQ(scene.sides[bottom].velocity, (Vec3{0.1, 0, 0}));
  EXPECT_EQ(scene.sides[top].kind, SideKind::open);
  EXPECT_EQ(scene.sides[front].fluid.kind, WallKind::slip);
  const Scene periodic = small({"walls.left=periodic", "walls.right=periodic"});
  EXPECT_EQ(periodic.sides[left].kind, SideKind::periodic);
  EXPECT_EQ(periodic.sides[right].kind, SideKind::periodic);
}

TEST(LoadScene, OverridesReplaceAWordByATableAndBack) {
  EXPECT_EQ(small({"walls.top={fluid=\"slip\", solid=\"slip\"}"}).sides[top].kind, SideKind::wall);
  EXPECT_EQ(small({"walls.top=no-slip", "walls.top.fluid=slip"}).sides[top].kind, SideKind::wall);
  EXPECT_EQ(small({"walls.top.fluid=slip", "walls.top=open"}).sides[top].kind, SideKind::open);
}

// What a side leaves open its own word says, then the parts of walls.all, then its word.
TEST(LoadScene, PartsOfAWallComeFromItsWordThenFromAll) {
  const auto wall = [](const std::vector<std::string>& overrides, int side) {
    const Side s = small(overrides).sides[side];
    return std::pair(s.fluid.kind, s.solid.kind);
  };
  using enum WallKind;
  EXPECT_EQ(wall({"walls.all=slip", "walls.left.solid=no-slip"}, left), std::pair(slip, no_slip));
  EXPECT_EQ(wall({"walls.all=slip", "walls.left.fluid=no-slip"}, left), std::pair(no_slip, slip));
  EXPECT_EQ(wall({"walls.left=slip", "walls.left.solid=no-slip"}, left), std::pair(slip, no_slip));
  EXPECT_EQ(wall({"walls.all.fluid=slip", "walls.left.solid=no-slip"}, left), std::pair(slip, no_slip));
  EXPECT_EQ(wall({"walls.all=slip", "walls.all.solid=no-slip"}, left), std::pair(slip, no_slip));
  EXPECT_EQ(wall({"walls.all=slip", "walls.left=no-slip", "walls.left.solid=slip"}, left),
            std::pair(no_slip, slip));
  EXPECT_EQ(wall({"walls.left.solid=slip"}, left), std::pair(no_slip, slip));
  EXPECT_EQ(wall({"walls.all=slip", "walls.left.solid=no-slip"}, right), std::pair(slip, slip));
}

TEST(LoadScene, FrictionOfAWallComesFromAll) {
  const std::vector<std::string> all{"walls.all.solid=coulomb", "walls.all.solid_friction=0.3"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> both = all;
    both.insert(both.end(), more.begin(), more.end());
    return small(both).sides[left].solid;
  };
  EXPECT_EQ(with({}), (PhaseWall{WallKind::coulomb, 0.3}));
  EXPECT_EQ(with({"walls.left.solid_friction=0.2"}), (PhaseWall{WallKind::coulomb, 0.2}));
  EXPECT_EQ(with({"walls.left.solid=coulomb"}), (PhaseWall{WallKind::coulomb, 0.3}));
  EXPECT_EQ(with({"walls.left.solid=slip"}), (PhaseWall{WallKind::slip, 0.0}));
  EXPECT_EQ(with({"walls.left=no-slip"}), (PhaseWall{WallKind::no_slip, 0.0}));
}

TEST(LoadScene, GrainsThatRubMoreThanGlassRubNoLessWhenFast) {
  EXPECT_EQ(small({"model.preset=sourced"}).contact.fast_friction, 0.643);
  EXPECT_EQ(small({"model.preset=sourced", "solid.friction=0.8"}).contact.fast_friction, 0.8);
  EXPECT_EQ(small({"model.preset=sourced", "solid.friction=0.8", "contact.fast_friction=0.9"})
                .contact.fast_friction,
            0.9);
}

TEST(LoadScene, AMovingWallKeepsWhatAllSays) {
  const Side side = small({"walls.all.fluid=slip", "walls.bottom.velocity=[0.1, 0]"}).sides[bottom];
  EXPECT_EQ(side.fluid.kind, WallKind::slip);
  EXPECT_EQ(side.solid.kind, WallKind::no_slip);
  EXPECT_EQ(side.velocity, (Vec3{0.1, 0, 0}));
}

TEST(LoadScene, TakesWholeNumbersForIntegers) {
  EXPECT_EQ(small({"scene.dimensions=2.0"}), small());
  EXPECT_EQ(small({"numerics.newton_max=20.0"}).numerics.newton_max, 20);
}

TEST(LoadScene, AGateStandsOnEitherSideOfTheBed) {
  EXPECT_EQ(small({"bed.x=0.3", "gate.position=0.3"}).gate->position, 0.3);
  EXPECT_EQ(small({"gate.position=0.15"}).gate->position, 0.15);
}

TEST(LoadScene, ReadsThreeDimensions) {
  const Scene scene = small({"scene.dimensions=3", "tank.size=[0.4, 0.12, 0.1]", "bed.z=0.02",
                             "bed.width=0.05", "reference=false", "grid.dz=0.02"});
  EXPECT_EQ(scene.grid.cells, (std::array<int, 3>{40, 12, 5}));
  EXPECT_DOUBLE_EQ(scene.bed->box.lower[2], 0.02);
  EXPECT_DOUBLE_EQ(scene.bed->box.upper[2], 0.07);
  EXPECT_EQ(scene.sides[front].fluid.kind, WallKind::no_slip);
}

TEST(LoadScene, DoesWithoutLiquidAndWithoutGrains) {
  const Scene dry = small({"liquid=false"});
  EXPECT_TRUE(dry.liquid_boxes.empty());
  EXPECT_EQ(dry.liquid, dry.gas);
  const Scene clear = small({"solid=false", "bed=false", "gate=false", "reference=false", "time.unit=s"});
  EXPECT_FALSE(clear.bed);
  EXPECT_GT(clear.solid.diameter, 0.0);
  EXPECT_EQ(clear.resolved.find("[solid]"), std::string::npos);
}

TEST(LoadScene, FillsInTheReference) {
  const Scene scene = small();
  ASSERT_TRUE(scene.reference);
  EXPECT_EQ(scene.reference->bead_friction, 0.4);
  EXPECT_EQ(scene.reference->wall_friction, 0.4);
  EXPECT_EQ(scene.reference->gate_friction, 0.4);
  EXPECT_EQ(small({"reference.wall_friction=0.3"}).reference->gate_friction, 0.3);
  EXPECT_EQ(scene.reference->bead_restitution, 0.9);
  EXPECT_EQ(scene.reference->packing, 0.57);
  EXPECT_EQ(scene.reference->release, ReferenceRelease::gate);
  EXPECT_GT(scene.reference->hold, 0.0);
  const Scene instant = small({"gate=false"});
  EXPECT_EQ(instant.reference->release, ReferenceRelease::instant);
  EXPECT_EQ(instant.reference->hold, 0.0);
}

const std::vector<std::vector<std::string>> variants{
    {},
    {"gate=false", "reference=false"},
    {"liquid=false"},
    {"time.unit=s", "output.field_interval=0.3", "numerics.cfl=0.1"},
    {"walls.bottom={solid=\"coulomb\", solid_friction=0.2, velocity=[0.1, 0]}", "walls.right=slip"},
    {"bed.y=floating", "solid.density=333", "bed.slope=45"},
    {R"(scene.title="A \"title\" with \\ and \u0007")", "tank.depth=0.3",
     "liquid.box={origin=[0,0], size=[0.1,0.1]}"},
    {"scene.dimensions=3", "tank.size=[0.4, 0.12, 0.1]", "reference.slice_depth=0.1", "reference=false"},
};

TEST(Resolved, ReadsBackToTheSameScene) {
  for (const auto& variant : variants) {
    const Scene scene = small(variant);
    Scene again = parse_scene(scene.resolved, "resolved");
    again.file = scene.file;
    EXPECT_EQ(scene, again) << scene.resolved << "\n---\n" << again.resolved;
  }
}

TEST(Hash, IsSixteenHexDigits) {
  const std::string hash = small().hash;
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
  EXPECT_NE(hash, small().reference_hash);
}

TEST(Hash, IgnoresNumericsOutputTitlesAndNotation) {
  for (const char* change :
       {"numerics.cfl=0.2", "grid.dx=0.005", "grid.dy=0.02", "time.end=5", "scene.title=other",
        "scene.name=other", "output.field_times=[1]", "output.series_interval=1", "bed.y=0.0",
        "solid.density=2.5e3", "walls.left=no-slip"}) {
    EXPECT_EQ(small({change}).hash, small().hash) << change;
  }
}

TEST(Hash, ChangesWithPhysicsGeometryAndReference) {
  for (const char* change :
       {"solid.friction=0.41", "tank.size=[0.5, 0.12]", "tank.gravity=9.8", "walls.left=slip",
        "gas.density=1.2", "liquid.level=0.08", "bed.solid_fraction=0.58", "gate.speed=2", "gate=false",
        "time.hold=0.1", "reference.seeds=[3]", "reference.floor=smooth", "tank.inclination=5",
        "walls.right.outflow_pressure=0", "obstacle={x0=[0.2], x1=[0.22], y0=[0], y1=[0.02]}"}) {
    EXPECT_NE(small({change}).hash, small().hash) << change;
    EXPECT_NE(small({change}).reference_hash, small().reference_hash) << change;
  }
}

// Records carry this hash. Whoever changes it makes all of them stale: a new key is to be `came_later`.
TEST(Hash, OfTheReferenceIsThatOfTheRecords) {
  EXPECT_EQ(small().reference_hash, "017bb24a0bccf9b4");
}

// Given or not: at its default such a key leaves a record current, at any other value it does not.
TEST(Hash, AKeyThatCameAfterTheRecordsCountsOnlyAwayFromItsDefault) {
  const Scene named = small({"reference.coarse_graining=1"});
  EXPECT_EQ(named.hash, small().hash);
  EXPECT_EQ(named.reference_hash, small().reference_hash);
  const Scene coarse = small({"reference.coarse_graining=2"});
  EXPECT_NE(coarse.hash, small().hash);
  EXPECT_NE(coarse.reference_hash, small().reference_hash);
  EXPECT_EQ(small({"reference.convection=upwind"}).reference_hash, small().reference_hash);
  EXPECT_NE(small({"reference.convection=van-leer"}).reference_hash, small().reference_hash);
  const Scene plate = small({"reference.gate_friction=0.4"});  // the walls'
  EXPECT_EQ(plate.reference_hash, small().reference_hash);
  const Scene smooth = small({"reference.gate_friction=0"});
  EXPECT_NE(smooth.hash, small().hash);
  EXPECT_NE(smooth.reference_hash, small().reference_hash);
}

// demvof takes its drag from it.
TEST(Hash, OfTheReferenceKnowsTheDragLaw) {
  const Scene named = small({"model.drag_law=paper"}), other = small({"model.drag_law=di-felice"});
  EXPECT_EQ(named.hash, small().hash);
  EXPECT_EQ(named.reference_hash, small().reference_hash);
  EXPECT_NE(other.hash, small().hash);
  EXPECT_NE(other.reference_hash, small().reference_hash);
}

// It is among the numerics, but says which grains bear load: a case with the paper's is what it was.
TEST(Hash, KnowsTheSurfaceOfTheBed) {
  const Scene named = small({"numerics.bed_surface=whole-cells"}),
              other = small({"numerics.bed_surface=part-cells"});
  EXPECT_EQ(small().hash, "320b056412e6bc9b");
  EXPECT_EQ(named.hash, small().hash);
  EXPECT_NE(other.hash, small().hash);
  EXPECT_EQ(other.reference_hash, small().reference_hash);
}

TEST(Hash, OfTheReferenceIgnoresTheContinuumsModel) {
  for (const char* change : {"model.drag=false", "contact.stiffness=1e7"}) {
    EXPECT_NE(small({change}).hash, small().hash) << change;
    EXPECT_EQ(small({change}).reference_hash, small().reference_hash) << change;
  }
}

TEST(Obstacles, AreReadAsOftenAsTheyStand) {
  const std::string two = std::string(small_case) + R"([[obstacle]]
x0 = 0.2
x1 = 0.22
y0 = 0
y1 = 0.02
[[obstacle]]
x0 = 0.3
x1 = 0.31
y0 = 0.05
y1 = 0.12
)";
  const Scene scene = parse_scene(two, "two.toml");
  ASSERT_EQ(scene.obstacles.size(), 2U);
  EXPECT_EQ(scene.obstacles[1], (Box{{0.3, 0.05, 0.0}, {0.31, 0.12, 1.0}}));
  EXPECT_NE(scene.resolved.find("[obstacle]\nx0 = [0.2, 0.3]"), std::string::npos) << scene.resolved;
  EXPECT_EQ(parse_scene(scene.resolved, "resolved.toml").obstacles, scene.obstacles);
  EXPECT_TRUE(parse_scene(two, "two.toml", std::vector<std::string>{"obstacle=false"}).obstacles.empty());
  // The place of a fault is that of its line.
  std::string beside = two;
  beside.replace(beside.find("x1 = 0.22"), 9, "x1 = 0.225");
  EXPECT_EQ(refusal_of(beside).substr(0, 29), "small.toml:39:6: obstacle.x1:");
}

TEST(Inlet, TakesWhatIsLeftOutFromTheCase) {
  const Scene scene = small({"walls.left.inflow=0.1", "walls.right.outflow_pressure=3"});
  EXPECT_EQ(scene.sides[left].kind, SideKind::inlet);
  EXPECT_EQ(scene.sides[left].inflow, (Inflow{0.1, 0.0, 1.0}));
  EXPECT_EQ(scene.sides[right].kind, SideKind::outlet);
  EXPECT_EQ(scene.sides[right].outflow, (Outflow{3.0, 0.07}));
  EXPECT_EQ(parse_scene(scene.resolved, "resolved.toml").sides, scene.sides);
}

// The open top is the one way out of what comes in before the obstacle.
TEST(Obstacles, MayStandBetweenAnInletAndAnOutletUnderAnOpenTop) {
  const std::string across = "obstacle={x0=[0.2], x1=[0.22], y0=[0], y1=[0.12]}";
  EXPECT_NO_THROW(small({"walls.left.inflow=0.1", "walls.right.outflow_pressure=0", across}));
}

}  // namespace
}  // namespace granvof::test
