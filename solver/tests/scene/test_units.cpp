// Units of keys, and a case restated in other units.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "solver/scene/keys.hpp"
#include "solver/scene/restate.hpp"
#include "solver/scene/scales.hpp"
#include "solver/scene/units.hpp"
#include "solver/tests/scene/case_fixture.hpp"

namespace granvof {
namespace {

using test::refusal;
using test::small;

TEST(Units, AreRead) {
  const auto expect = [](const char* unit, Dimension dimension) {
    ASSERT_TRUE(dimension_of(unit)) << unit;
    EXPECT_EQ(*dimension_of(unit), dimension) << unit;
  };
  expect("", {});
  expect("-", {});
  expect("degrees", {});
  expect("m", {0, 1, 0});
  expect("m/s2", {0, 1, -2});
  expect("m2/s2", {0, 2, -2});
  expect("kg/m3", {1, -3, 0});
  expect("kg/m3 s", {1, -3, -1});
  expect("Pa s", {1, -1, -1});
  expect("J", {1, 2, -2});
  for (const char* unit : {"mm", "g/cm3", "m/", "m//s", "m ", "2", "m2x"})
    EXPECT_FALSE(dimension_of(unit)) << unit;
}

TEST(Units, OfEveryKeyAreKnown) {
  for (const case_file::Key& key : case_file::keys())
    EXPECT_TRUE(key.unit == case_file::unit_of_times || dimension_of(key.unit))
        << key.name << " [" << key.unit << "]";
}

TEST(Units, FactorsMultiplyByDimension) {
  const UnitFactors f{3.0, 7.0, 0.2};
  EXPECT_DOUBLE_EQ(f.of({1, -1, -2}), 3.0 / 7.0 / 0.04);
  EXPECT_EQ(f.of({}), 1.0);
  EXPECT_EQ((UnitFactors{64.0, 0.125, 512.0}.of({1, -3, 1})), 64.0 * 512.0 * 512.0);
}

TEST(Restate, MultipliesEveryDimensionalKey) {
  const Scene a = small({"tank.gravity=4", "time.unit=s", "output.checkpoint_interval=60"});
  const Scene b = parse_scene(restated_case(a, {2.0, 8.0, 0.5}), "restated");
  EXPECT_EQ(b.name, a.name);
  EXPECT_EQ(b.grid.cells, a.grid.cells);
  EXPECT_EQ(b.tank[0], 8.0 * a.tank[0]);
  EXPECT_EQ(b.tank[2], 8.0 * a.tank[2]);
  EXPECT_EQ(b.gravity, 4.0 * 8.0 / 0.25);
  EXPECT_EQ(b.solid.density, a.solid.density * 2.0 / 512.0);
  EXPECT_EQ(b.liquid.viscosity, a.liquid.viscosity * 2.0 / 8.0 / 0.5);
  EXPECT_EQ(b.solid.friction, a.solid.friction);
  EXPECT_EQ(b.contact.stiffness, a.contact.stiffness * 2.0 / 8.0 / 0.25);
  EXPECT_EQ(b.contact.regularisation, 0.5 * a.contact.regularisation);
  EXPECT_EQ(b.contact.exponent, a.contact.exponent);
  EXPECT_EQ(b.bed->box.upper[1], 8.0 * a.bed->box.upper[1]);
  EXPECT_EQ(b.gate->speed, 16.0 * a.gate->speed);
  EXPECT_EQ(b.numerics.dt_max, 0.5 * a.numerics.dt_max);
  EXPECT_EQ(b.numerics.dt_min, 0.5 * a.numerics.dt_min);
  EXPECT_EQ(b.numerics.volume_tolerance, a.numerics.volume_tolerance);
  EXPECT_EQ(b.times.end, 0.5 * a.times.end);
  EXPECT_EQ(b.times.field_times[1], 0.5 * a.times.field_times[1]);
  EXPECT_EQ(b.times.checkpoint_interval, 60.0);
  EXPECT_EQ(b.reference->young, a.reference->young * 2.0 / 8.0 / 0.25);
  EXPECT_EQ(b.reference->seeds, a.reference->seeds);
}

TEST(Restate, NeedsNoStatedSteps) {
  // The defaults follow the scene: a model of 1 to 100 by Froude's rule takes steps a tenth as long.
  const Scene a = small(), b = small({"tank.size=[0.004, 0.0012]", "grid.dx=1e-4", "liquid.level=7e-4",
                                      "bed.length=1e-3", "bed.height=5e-4", "reference=false"});
  EXPECT_DOUBLE_EQ(a.numerics.dt_max, 0.07 * a.times.unit);
  EXPECT_DOUBLE_EQ(b.numerics.dt_max, 0.1 * a.numerics.dt_max);
  EXPECT_DOUBLE_EQ(b.numerics.dt_min, 0.1 * a.numerics.dt_min);
  EXPECT_DOUBLE_EQ(small({"numerics.dt_max=5e-3"}).numerics.dt_min, 1e-9);
}

TEST(Restate, RefusesFactorsThatLeadBeyondWhatKeysTake) {
  EXPECT_NE(refusal([] { restated_case(small(), {.mass = 1e40}); }).find("of a size within"),
            std::string::npos);
}

TEST(Restate, LeavesTimesInColumnUnits) {
  const Scene a = small(), b = parse_scene(restated_case(a, {1.0, 0.01, 0.1}), "restated");
  EXPECT_NEAR(b.times.end, 0.1 * a.times.end, 1e-15);
  EXPECT_NE(b.resolved.find("\nend = 10\n"), std::string::npos) << b.resolved;
}

TEST(Restate, BackGivesTheCase) {
  const Scene a = small();
  const Scene there = parse_scene(restated_case(a, {4.0, 0.25, 16.0}), "restated");
  EXPECT_EQ(restated_case(there, {0.25, 4.0, 0.0625}), a.resolved);
}

TEST(Scales, OfABed) {
  const Scales s = scales_of(small());
  EXPECT_DOUBLE_EQ(s.length, 0.05);
  EXPECT_DOUBLE_EQ(s.velocity, std::sqrt(9.81 * 0.05));
  EXPECT_DOUBLE_EQ(s.time(), small().times.unit);
  EXPECT_DOUBLE_EQ(s.pressure, 1500.0 * 9.81 * 0.05);
  const Vec3 tank = small().tank;  // full of liquid at that velocity
  EXPECT_DOUBLE_EQ(s.energy, 0.5 * small().liquid.density * 9.81 * 0.05 * tank[0] * tank[1] * tank[2]);
  EXPECT_DOUBLE_EQ(scales_of(small({"liquid=false"})).pressure, 2499.0 * 9.81 * 0.05);
  EXPECT_DOUBLE_EQ(scales_of(small({"solid.density=1000"})).pressure, 9.81 * 0.05);
}

TEST(Scales, OfWallsAndOfWhatHasNeitherWeightNorWalls) {
  const std::vector<std::string> weightless{"tank.gravity=0", "time.unit=s"};
  std::vector<std::string> driven = weightless;
  driven.emplace_back("walls.bottom.velocity=[2.0, 0.0]");
  EXPECT_DOUBLE_EQ(scales_of(small(driven)).velocity, 2.0);
  EXPECT_DOUBLE_EQ(scales_of(small(driven)).pressure, 2500.0 * 4.0);
  const Scales still = scales_of(small(weightless));
  EXPECT_DOUBLE_EQ(still.time(), 10.0);
  EXPECT_DOUBLE_EQ(still.pressure, 2500.0 * 0.005 * 0.005);
}

TEST(Scales, WithoutABed) {
  const std::vector<std::string> pool{"bed=false", "gate=false", "reference=false", "time.unit=s"};
  EXPECT_DOUBLE_EQ(scales_of(small(pool)).length, 0.07);
  std::vector<std::string> gas = pool;
  gas.emplace_back("liquid=false");
  EXPECT_DOUBLE_EQ(scales_of(small(gas)).length, 0.12);
}

TEST(Scales, AreRestatedWithTheCase) {
  const UnitFactors f{1.0 / 150.0, 0.01, 1000.0};
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{},
        {"solid.density=1000"},
        {"tank.gravity=0", "time.unit=s"},
        {"bed=false", "solid=false", "gate=false", "reference=false", "time.unit=s"}}) {
    const Scales a = scales_of(small(set)),
                 b = scales_of(parse_scene(restated_case(small(set), f), "restated"));
    EXPECT_NEAR(b.length / a.length / f.of({0, 1, 0}), 1.0, 1e-14);
    EXPECT_NEAR(b.velocity / a.velocity / f.of({0, 1, -1}), 1.0, 1e-14);
    EXPECT_NEAR(b.pressure / a.pressure / f.of({1, -1, -2}), 1.0, 1e-14);
    EXPECT_NEAR(b.energy / a.energy / f.of({1, 2, -2}), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace granvof
