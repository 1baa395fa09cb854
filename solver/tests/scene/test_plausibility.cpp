// What users mistake: each is named once, by key, value and usual range; what is meant is not.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/plausibility/plausibility.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

std::vector<std::string> keys_of(const std::vector<Implausible>& findings) {
  std::vector<std::string> keys;
  for (const Implausible& finding : findings) keys.push_back(finding.key);
  return keys;
}

struct Mistake {
  std::string what;                    // of the test
  std::vector<std::string> overrides;  // of the small case
  std::vector<std::string> keys;       // that are named, no others
  std::string part;                    // of the first text
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.what;
}

class Mistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreNamedByKeyValueAndUsualRange) {
  const auto findings = plausibility(small(GetParam().overrides));
  EXPECT_EQ(keys_of(findings), GetParam().keys);
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(text_of(findings.front()).find(GetParam().part), std::string::npos) << text_of(findings.front());
}

const std::vector<Mistake> mistakes{
    {"friction_in_degrees", {"solid.friction=21.8"}, {"solid.friction"}, "= 21.8: usual is 0.05 to 1.5"},
    {"friction_in_percent", {"solid.friction=40"}, {"solid.friction"}, "0.839 for 40 degrees"},
    {"no_friction", {"solid.friction=0"}, {"solid.friction"}, "= 0: usual is 0.05 to 1.5"},
    {"wall_friction_in_degrees",
     {"walls.bottom.solid=coulomb", "walls.bottom.solid_friction=20"},
     {"walls.bottom.solid_friction"},
     "= 20: usual is at most 1.5"},
    {"grains_in_mm", {"solid.diameter=0.8"}, {"solid.diameter"}, "= 0.8 m: usual is 1e-05 to 0.1 m"},
    {"grains_in_micrometres", {"solid.diameter=8e-10"}, {"solid.diameter"}, "= 8e-10 m"},
    {"grains_larger_than_a_cell",
     {"grid.dx=0.005", "solid.diameter=6e-3"},
     {"solid.diameter", "reference.slice_depth"},
     "at most 0.005 m"},
    {"grains_larger_than_the_bed",
     {"solid.diameter=0.02"},
     {"solid.diameter", "reference.cell", "reference.slice_depth"},
     "not three grains"},
    {"cells_far_below_a_grain",
     {"grid.dx=0.0001", "solid.diameter=0.8e-3"},
     {"grid.dx", "solid.diameter"},
     "grid.dx = 0.0001 m: usual is 0.0002 to 0.8 m"},
    {"grains_in_g_per_cm3",
     {"solid.density=2.5"},
     {"solid.density", "reference.dt"},
     "= 2.5 kg/m3: usual is 10 to 2.3e+04"},
    {"liquid_in_g_per_cm3", {"liquid.density=1.0"}, {"liquid.density"}, "= 1 kg/m3: usual is 400 to 1.4e+04"},
    {"gas_in_g_per_cm3", {"gas.density=0.0012"}, {"gas.density"}, "0.0012 kg/m3: usual is 0.05 to 200"},
    {"fluids_exchanged",
     {"gas.density=1000", "liquid.density=1"},
     {"gas.density", "liquid.density"},
     "gas.density = 1000 kg/m3"},
    {"water_kinematic",
     {"liquid.viscosity=1e-6"},
     {"liquid.viscosity"},
     "= 1e-06 Pa s: usual is 0.0001 to 10"},
    {"water_in_cP", {"liquid.viscosity=1"}, {"liquid.viscosity"}, "usual is at most 0.3 Pa s"},
    {"oil_in_cP", {"liquid.density=950", "liquid.viscosity=20"}, {"liquid.viscosity"}, "= 20 Pa s"},
    {"air_in_cP", {"gas.viscosity=0.018"}, {"gas.viscosity"}, "4e-06 to 0.0001 Pa s"},
    {"gravity_in_cm", {"tank.gravity=981"}, {"tank.gravity"}, "= 981 m/s2: usual is 1 to 30"},
    {"from_the_vertical", {"tank.inclination=70"}, {"tank.inclination"}, "= 70 degrees: usual is at most 60"},
    {"inflow_in_mm", {"walls.right.inflow=200"}, {"walls.right.inflow"}, "= 200 m/s"},
    {"gravity_in_km", {"tank.gravity=0.00981"}, {"tank.gravity"}, "= 0.00981 m/s2"},
    {"gate_in_mm", {"gate.speed=1000"}, {"gate.speed"}, "= 1000 m/s"},
    {"gate_too_slow", {"gate.speed=0.001"}, {"gate.speed"}, "usual is 0.07 to 50 m/s"},
    {"gate_beside_its_face",
     {"gate.position=0.1049"},
     {"gate.position"},
     "= 0.1049 m: usual is a face of the cells, the nearest 0.1 m"},
    {"gate_before_its_face", {"gate.position=0.1051"}, {"gate.position"}, "the nearest 0.11 m"},
    {"bed_that_ends_in_a_cell", {"bed.length=0.104"}, {"gate.position"}, "= 0.104 m"},
    {"no_liquid_in_the_tank",
     {"liquid=false", "liquid.density=1000", "liquid.viscosity=1e-3"},
     {"liquid.level"},
     "= nothing: usual is a level or a liquid.box"},
    {"no_bed_in_the_tank",
     {"bed=false", "gate=false", "reference=false", "time.unit=s"},
     {"bed"},
     "the case has a [solid], but no grains in the tank"},
    {"gate_off_the_bed", {"gate.position=0.2"}, {"gate.position"}, "= 0.2 m: usual is 0.1 to 0.11 m"},
    {"elastic_grains", {"solid.restitution=1"}, {"solid.restitution"}, "= 1: usual is 0.05 to 0.99"},
    {"too_soft", {"contact.stiffness=1e4"}, {"contact.stiffness"}, "= 10000 Pa: usual is 2.36e+05 to 1e+12"},
    {"too_stiff", {"contact.stiffness=1e15"}, {"contact.stiffness"}, "1e+12"},
    {"steep_contact",
     {"contact.exponent=9"},
     {"contact.stiffness", "contact.exponent"},
     "usual is none, which would be at least"},
    {"springs", {"bed.solid_fraction=0.61"}, {"bed.solid_fraction"}, "times the energy of its own height"},
    {"dense_crystal", {"contact.solid_fraction_max=0.9"}, {"contact.solid_fraction_max"}, "0.74"},
    {"step", {"numerics.dt_max=0.05"}, {"numerics.dt_max"}, "= 0.05 s: usual is 7.14e-08 to 0.0143 s"},
    {"end_in_ms", {"time.unit=s", "time.end=1e6"}, {"time.end"}, "= 1000000 s"},
    {"idle_steps", {"numerics.dt_max=1e-8"}, {"numerics.dt_max"}, "a far shorter one only costs"},
    {"idle_courant", {"numerics.cfl=1e-6"}, {"numerics.cfl"}, "= 1e-06: usual is at least 0.001"},
    {"hold_in_ms", {"time.hold=1e5"}, {"time.hold"}, "= 100000 s: usual is 7.14e-08 to 71.4 s"},
    {"film_of_nothing", {"liquid.level=1e-9"}, {"liquid"}, "= 1e-09 m: usual is at least 0.001 m"},
    {"bed_of_no_grain", {"bed.solid_fraction=1e-12"}, {"bed.solid_fraction"}, "holds not one grain"},
    {"thin_bands", {"bed.colour=layers", "bed.colour_size=0.002"}, {"bed.colour_size"}, "finer than a cell"},
    {"thin_bed",
     {"bed.height=0.015", "solid.diameter=1e-4"},
     {"bed.height", "reference.cell", "reference.dt"},
     "two cells"},
    {"high_cells", {"grid.dx=0.002", "grid.dy=0.012"}, {"grid.dy"}, "= 0.012 m: usual is 0.0002 to 0.008 m"},
    {"wide_cells", {"grid.dx=0.02", "grid.dy=0.0015"}, {"grid.dy"}, "13.3 times"},
    {"flat_cells", {"grid.dy=1e-4"}, {"grid.dy", "solid.diameter"}, "grid.dy = 0.0001 m"},
    {"one_band",
     {"bed.colour=layers", "bed.colour_size=0.2"},
     {"bed.colour_size"},
     "usual is 0.01 to 0.05 m"},
    {"absolute_pressure",
     {"walls.left.outflow_pressure=101325"},
     {"walls.left.outflow_pressure"},
     "= 101325 Pa: usual is at most 3.92e+04"},
    {"beads_in_MPa", {"reference.young=5"}, {"reference.young"}, "= 5 Pa: usual is 1.23e+04 to 1e+12"},
    {"step_beyond_a_contact", {"reference.dt=1e-4"}, {"reference.dt"}, "= 0.0001 s"},
    {"bead_friction_in_degrees", {"reference.bead_friction=21.8"}, {"reference.bead_friction"}, "degrees?"},
    {"beads_of_another_bed", {"reference.packing=0.3"}, {"reference.packing"}, "usual is 0.5 to 0.74"},
    {"law_of_liquids_in_air",
     {"liquid=false", "model.friction_law=viscous"},
     {"model.friction_law"},
     "a viscous liquid stops"},
    {"rolling_law_without_friction",
     {"model.contact_friction=false", "model.friction_law=inertial"},
     {"model.friction_law"},
     "without model.contact_friction"},
    {"whole_stress_without_collisions",
     {"model.granular_temperature=off", "model.whole_stress_friction=true"},
     {"model.whole_stress_friction"},
     "without model.contact_friction, model.granular_temperature and model.kinetic_viscosity"},
    {"agitated_without_drag",
     {"model.drag=false", "model.agitation_drag=true"},
     {"model.agitation_drag"},
     "it is drag too"},
    {"colour_without",
     {"model.colour=false", "bed.colour=layers", "bed.colour_size=0.01"},
     {"bed.colour"},
     ""},
    {"loose_tolerance", {"numerics.volume_tolerance=0.1"}, {"numerics.volume_tolerance"}, ""},
    {"wall_in_mm", {"walls.bottom.velocity=[200, 0]"}, {"walls.bottom.velocity"}, "= 200 m/s"},
    {"shear_without",
     {"contact.critical_solid_fraction=0.6"},
     {"contact.critical_solid_fraction"},
     "no effect without model.shear_dilatancy"},
    {"arrest_without", {"contact.stop_length=2"}, {"contact.stop_length"}, "without model.thin_layer_arrest"},
    {"pressure_without",
     {"model.dilatancy_pressure=false", "contact.dilatancy_factor=0.1"},
     {"contact.dilatancy_factor"},
     "without model.dilatancy_pressure"},
};
INSTANTIATE_TEST_SUITE_P(All, Mistakes, ::testing::ValuesIn(mistakes),
                         [](const auto& i) { return i.param.what; });

// What a preset sets is judged as if the case had stated it.
TEST(Plausibility, KnowsWhatThePresetSets) {
  const std::string dense = "bed.solid_fraction=0.61", critical = "contact.critical_solid_fraction=0.6";
  EXPECT_EQ(keys_of(plausibility(small({dense, critical, "model.preset=paper"}))),
            (std::vector<std::string>{"contact.critical_solid_fraction", "bed.solid_fraction"}));
  EXPECT_EQ(keys_of(plausibility(small({dense, critical, "model.preset=advised"}))),
            std::vector<std::string>{"contact.critical_solid_fraction"});
  EXPECT_EQ(keys_of(plausibility(small({dense, critical, "contact.stop_length=2", "model.preset=sourced"}))),
            std::vector<std::string>{});
  EXPECT_EQ(keys_of(plausibility(small({dense, "model.preset=advised", "model.packing=uniform"}))),
            std::vector<std::string>{"bed.solid_fraction"});
}

TEST(Plausibility, IsAMatterOfTheBedsWeight) {
  // At 0.58 the contacts of a low bed hold more than its height; those of a high one bear its weight so.
  EXPECT_EQ(keys_of(plausibility(small({"bed.solid_fraction=0.58"}))),
            (std::vector<std::string>{"bed.solid_fraction"}));
  EXPECT_EQ(keys_of(plausibility(small({"bed.solid_fraction=0.61", "model.shear_dilatancy=true"}))),
            std::vector<std::string>{});
  EXPECT_EQ(keys_of(plausibility(
                small({"tank.size=[40, 12]", "grid.dx=0.1", "liquid.level=7", "bed.length=10",
                       "bed.height=10", "bed.solid_fraction=0.58", "gate.speed=5", "reference.cell=0.1"}))),
            std::vector<std::string>{});
}

// A gate at either end of its bed holds it.
TEST(Plausibility, AGateStandsAtEitherEndOfTheBed) {
  EXPECT_EQ(keys_of(plausibility(small({"bed.x=0.1", "gate.position=0.1"}))), std::vector<std::string>{});
  EXPECT_EQ(keys_of(plausibility(small({"bed.x=0.1", "gate.position=0.2"}))), std::vector<std::string>{});
}

// Without gravity: what sends the heaviest fluid through the tank a thousand times in the run.
TEST(Plausibility, APressureWithoutWeightIsAMatterOfTheRunsLength) {
  const std::vector<std::string> weightless{"tank.gravity=0", "time.unit=s", "time.end=20"};
  const auto with = [&](double pressure) {
    std::vector<std::string> all = weightless;
    all.push_back(fmt::format("walls.left.outflow_pressure={}", pressure));
    return keys_of(plausibility(small(all)));
  };
  const Scene scene = small(weightless);
  const double speed = 1e3 * scene.tank[0] / 20.0, largest = scene.liquid.density * speed * speed;
  EXPECT_EQ(with(0.9 * largest), std::vector<std::string>{});
  EXPECT_EQ(with(1.1 * largest), std::vector<std::string>{"walls.left.outflow_pressure"});
}

// A bed of a few hundred grains is one; of half a grain it is none.
// A chute on which mu(I) and collisions both grow with the rate of shear; a block on a Coulomb floor is none,
// nor is what lies flatter than its friction.
TEST(Plausibility, AChuteCountsTheRateOfShearOnce) {
  const auto on_a_chute = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"walls.left=periodic", "walls.right=periodic", "walls.bottom=no-slip",
                               "gate=false", "liquid=false", "bed.length=0.3", "model.preset=advised"});
    return keys_of(plausibility(small(more)));
  };
  const std::vector<std::string> said{"tank.inclination"};
  EXPECT_EQ(on_a_chute({"tank.inclination=26"}), said);
  EXPECT_EQ(on_a_chute({"tank.inclination=-26"}), said);
  EXPECT_NE(on_a_chute({"tank.inclination=15"}), said);
  for (const char* other :
       {"model.whole_stress_friction=true", "model.kinetic_viscosity=false", "model.friction_law=constant",
        "walls.bottom={fluid=\"slip\", solid=\"coulomb\", solid_friction=0.3}"})
    EXPECT_NE(on_a_chute({"tank.inclination=26", other}), said) << other;
}

TEST(Plausibility, ABedHoldsAGrainAtLeast) {
  const Scene scene = small();
  const double one = std::numbers::pi / 6.0 * std::pow(scene.solid.diameter, 3) /
                     (0.1 * 0.05 * scene.tank[2]);  // solid fraction of one grain in the bed
  const auto of_grains = [&](double n) {
    return keys_of(plausibility(small({fmt::format("bed.solid_fraction={}", n * one)})));
  };
  EXPECT_EQ(of_grains(2.0), std::vector<std::string>{});
  EXPECT_EQ(of_grains(0.5), std::vector<std::string>{"bed.solid_fraction"});
}

TEST(Plausibility, TakesWhatIsLeftOutForMeant) {
  EXPECT_EQ(keys_of(plausibility(small())), std::vector<std::string>{});
  // Inviscid and weightless on purpose.
  EXPECT_EQ(keys_of(plausibility(small({"gas.viscosity=0", "liquid.viscosity=0"}))),
            std::vector<std::string>{});
  EXPECT_EQ(keys_of(plausibility(small({"tank.gravity=0", "time.unit=s"}))), std::vector<std::string>{});
  EXPECT_EQ(keys_of(plausibility(small({"liquid=false"}))), std::vector<std::string>{});
}

// All that is shipped is meant (a material is no case), but for two beds that are known to spring, two
// coarse-grained sections and a state without gradients whose grains are larger than their cells, and a grid
// of 5 mm that has no face where the gate of s1 stands.
// Nothing varies along an axis of one cell, which may be as long as the tank is.
TEST(Plausibility, ATankOfOneCellAcrossHasNoLongCells) {
  const auto rows = [](const std::string& dx) {
    return keys_of(plausibility(small({"gate=false", "grid.dy=0.002", "bed.length=0.4", dx})));
  };
  EXPECT_EQ(std::ranges::count(rows("grid.dx=0.04"), "grid.dy"), 1);
  EXPECT_EQ(std::ranges::count(rows("grid.dx=0.4"), "grid.dy"), 0);
}

TEST(Plausibility, IsSilentOnShippedCases) {
  namespace fs = std::filesystem;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(cases_directory())) {
    if (entry.path().extension() != ".toml" || entry.path().parent_path().filename() == "materials") continue;
    const Scene scene = load_scene(entry.path());
    std::vector<std::string> expected;
    if (scene.name == "s1-dense" || scene.name == "rondon-dense") expected = {"bed.solid_fraction"};
    if (scene.name.starts_with("sw-2d") || scene.name.starts_with("fw-2d") || scene.name == "shear")
      expected = {"solid.diameter"};
    if (scene.name == "s1-advised") expected = {"gate.position"};
    EXPECT_EQ(keys_of(plausibility(scene)), expected) << scene.name;
    ++count;
  }
  EXPECT_GT(count, 30);
}

}  // namespace
}  // namespace granvof::test
