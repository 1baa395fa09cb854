// Every class of bad input: one line that names place, key, what was given and what is allowed.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

struct Refused {
  std::string what;                    // of the test
  std::vector<std::string> overrides;  // of the small case
  std::vector<std::string> parts;      // of the message
};

void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.what;
}

class Overrides : public ::testing::TestWithParam<Refused> {};

TEST_P(Overrides, AreRefusedInOneLine) {
  const std::string message = refusal_of(small_case, GetParam().overrides);
  ASSERT_NE(message, "") << "was accepted";
  for (const std::string& part : GetParam().parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in: " << message;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const std::vector<Refused> values{
    {"negative", {"solid.friction=-0.4"}, {"--set: solid.friction: got -0.4, allowed: a number >= 0"}},
    {"zero_size", {"solid.diameter=0"}, {"solid.diameter: got 0, allowed: a number > 0 [m]"}},
    {"negative_tank", {"tank.size=[0.4, -0.12]"}, {"tank.size: got [0.4, -0.12]", "each > 0 [m]"}},
    {"not_a_number", {"solid.density=nan"}, {"solid.density: got nan", "a number > 0"}},
    {"infinite", {"gas.viscosity=inf"}, {"gas.viscosity: got inf"}},
    {"text_for_number", {"solid.density=heavy"}, {"solid.density: got \"heavy\""}},
    {"number_for_text", {"scene.title=3"}, {"scene.title: got 3", "text in quotes"}},
    {"number_for_switch", {"model.drag=1"}, {"model.drag: got 1, allowed: true or false"}},
    {"fraction_for_integer",
     {"numerics.newton_max=2.5"},
     {"numerics.newton_max: got 2.5", "an integer in ["}},
    {"unknown_word", {"numerics.solid_flux=upwnd"}, {R"(got "upwnd", allowed: "upwind" | "limited")"}},
    {"cfl_zero", {"numerics.cfl=0"}, {"numerics.cfl: got 0, allowed: a number in (0, 0.9]"}},
    {"cfl_large", {"numerics.cfl=0.91"}, {"numerics.cfl: got 0.91, allowed: a number in (0, 0.9]"}},
    {"dt_order",
     {"numerics.dt_max=0.005", "numerics.dt_min=0.01"},
     {"numerics.dt_min: got 0.01", "at most numerics.dt_max = 0.005 s"}},
    {"bands_without_size", {"bed.colour=layers"}, {"bed.colour_size", "required with bed.colour"}},
    {"size_without_bands", {"bed.colour_size=0.01"}, {"bed.colour_size: got 0.01", "only with bands"}},
    {"unknown_colour", {"bed.colour=stripes"}, {"got \"stripes\"", R"("layers" | "columns" | "checks")"}},
    {"mixed_list", {"tank.size=[0.4, \"high\"]"}, {"tank.size: got ", "list of numbers"}},
    {"far_too_large",
     {"solid.friction=1e300"},
     {"got 1e+300", "a number >= 0, of a size within [1e-30, 1e+30]"}},
    {"far_too_small", {"bed.length=1e-300"}, {"got 1e-300", "of a size within [1e-30, 1e+30]"}},
    {"one_of_a_list",
     {"tank.size=[0.4, 1e200]"},
     {"tank.size: got [0.4, 1e+200]", "each > 0 [m], of a size"}},
    {"exponent", {"contact.exponent=1e6"}, {"contact.exponent: got 1000000", "a number in (0, 10]"}},
    {"few_iterations",
     {"numerics.newton_max=1"},
     {"numerics.newton_max: got 1, allowed: an integer in [4, 1000]"}},
    {"two_dimensions_and_a_bit",
     {"scene.dimensions=2.1"},
     {"scene.dimensions: got 2.1", "an integer in [2, 3]"}},
    {"name_up", {"scene.name=\"..\""}, {"scene.name: got \"..\"", "the name of a file"}},
    {"name_here", {"scene.name=\".\""}, {"scene.name: got \".\"", "the name of a file"}},
    {"name_elsewhere", {"scene.name=\"../s1\""}, {"scene.name: got \"../s1\"", "no \"/\""}},
    {"name_of_two_lines", {"scene.name=\"a\\nb\""}, {"scene.name: got \"a\\u000Ab\""}},
    {"name_too_long",
     {"scene.name=" + std::string(101, 'a')},
     {"scene.name: got \"aaa", "at most 100 bytes"}},
    {"date", {"time.end=2020-01-01"}, {"time.end: got 2020-01-01"}},
    {"seed_fraction", {"reference.seeds=[1.5]"}, {"reference.seeds: got [1.5]", "list of integers"}},
    {"seed_twice", {"reference.seeds=[1, 1]"}, {"reference.seeds: got [1, 1]", "each seed once"}},
    {"no_seed", {"reference.seeds=[]"}, {"reference.seeds: got []", "at least one seed"}},
    {"poisson", {"reference.poisson=0.5"}, {"reference.poisson: got 0.5", "(-1, 0.5)"}},
    {"reference_dt",
     {"reference.dt=1e-3"},
     {"reference.dt: got 0.001", "at most reference.fluid_dt = 0.0001 s"}},
    {"coarse_reference_dt",
     {"reference.dt=4e-5", "reference.coarse_graining=4"},
     {"reference.dt: got 4e-05", "at most reference.fluid_dt / reference.coarse_graining = 2.5e-05 s"}},
    {"finer_than_grains",
     {"reference.coarse_graining=0.5"},
     {"reference.coarse_graining: got 0.5", "a number in [1, 10]"}},
    {"rough_no_gate",
     {"gate=false", "reference.gate_friction=0.1"},
     {"reference.gate_friction: got 0.1", "no such key without a [gate]"}},
    {"far_coarser",
     {"reference.coarse_graining=11"},
     {"reference.coarse_graining: got 11", "a number in [1, 10]"}},
};
const std::vector<Refused> keys{
    {"misspelt",
     {"solid.fricton=0.4"},
     {"--set: solid.fricton: unknown key", "did you mean solid.friction?"}},
    {"misspelt_table", {"sold.friction=0.4"}, {"sold.friction: unknown key", "did you mean solid.friction?"}},
    {"far_key", {"solid.colour_of_the_beads=1"}, {"unknown key", "allowed in [solid]: density, diameter"}},
    {"far_table", {"weather.temperature_outside=3"}, {"unknown key", "allowed tables: scene, tank"}},
    {"value_for_table", {"solid=3"}, {"solid: got 3, allowed: a table [solid]"}},
    {"required_table_dropped", {"gas=false"}, {"--set: gas: got false, allowed: a table [gas]"}},
    {"walls_dropped", {"walls=false"}, {"--set: walls: got false, allowed: a table [walls]"}},
    {"empty_part", {"walls.left={}"}, {"walls.left: got {", "\"no-slip\" | \"slip\""}},
    {"not_an_override", {"dx"}, {"--set: got dx, allowed: table.key=value"}},
    {"empty_override", {"grid.dx="}, {"--set: grid.dx: got nothing"}},
    {"bad_override_value", {"grid.dx=0.0.1"}, {"--set: grid.dx: got 0.0.1", "a TOML value"}},
    {"two_in_one", {"grid.dx=0.01\nsolid.friction=1"}, {"--set: grid.dx: got 0.01"}},
};
const std::vector<Refused> geometry{
    {"cells",
     {"grid.dx=0.03"},
     {"grid.dx: got 0.03", "x = 0.4 m", "0.0285714286 (14 cells)", "0.0307692308 (13 cells)"}},
    {"cells_y", {"grid.dy=0.05"}, {"grid.dy: got 0.05", "y = 0.12 m", "0.04 (3 cells)", "0.06 (2 cells)"}},
    {"larger_than_tank", {"grid.dx=0.5"}, {"grid.dx: got 0.5", "0.4 (1 cells)"}},
    {"too_many_cells", {"grid.dx=1e-7"}, {"grid.dx: got 1e-07", "at most 1000000000 cells"}},
    {"dz_in_2d", {"grid.dz=0.01"}, {"grid.dz: got 0.01", "no such key in 2D"}},
    {"components", {"tank.size=[0.4, 0.12, 0.1]"}, {"tank.size: got [0.4, 0.12, 0.1]", "2 numbers"}},
    {"dimensions", {"scene.dimensions=4"}, {"scene.dimensions: got 4", "in [2, 3]"}},
    {"bed_too_long", {"bed.x=0.35"}, {"bed.length: got 0.1", "the tank ends at 0.4 m"}},
    {"bed_too_high", {"bed.y=0.08"}, {"bed.height: got 0.05", "the tank ends at 0.12 m"}},
    {"bed_width_in_2d", {"bed.width=0.1"}, {"bed.width: got 0.1", "no such key in 2D"}},
    {"packing_zero", {"bed.solid_fraction=0"}, {"bed.solid_fraction: got 0, allowed: a number in (0, 1)"}},
    {"packing_high",
     {"bed.solid_fraction=0.64"},
     {"bed.solid_fraction: got 0.64, allowed: a number in (0, 0.63]"}},
    {"slope_too_flat", {"bed.slope=20"}, {"bed.slope: got 20", "at least 26.57 degrees"}},
    {"contact_order", {"contact.solid_fraction_min=0.63"}, {"below contact.solid_fraction_max = 0.63"}},
    {"critical_below",
     {"model.shear_dilatancy=true", "contact.critical_solid_fraction=0.57"},
     {"got 0.57", "between contact.solid_fraction_min = 0.57 and contact.solid_fraction_max = 0.63"}},
    {"critical_above",
     {"model.shear_dilatancy=true", "contact.critical_solid_fraction=0.63"},
     {"contact.critical_solid_fraction: got 0.63"}},
    {"arrest_friction",
     {"model.thin_layer_arrest=true", "contact.fast_friction=0.3"},
     {"contact.fast_friction: got 0.3",
      "at least solid.friction = 0.4, with friction_law = \"inertial\" or "
      "\"viscous\", or thin_layer_arrest (model.preset = \"paper\")"}},
    {"fast_friction_of_a_preset",
     {"model.preset=sourced", "solid.friction=0.7"},
     {"contact.fast_friction: got 0.643 (the default)", "(model.preset = \"sourced\")"}},
    {"contact_dense", {"contact.dense_solid_fraction=0.65"}, {"at most contact.solid_fraction_max = 0.63"}},
    {"level_above_tank",
     {"liquid.level=0.13"},
     {"liquid.level: got 0.13", "at most the tank's height 0.12 m"}},
    {"half_a_box", {"liquid.box.size=[0.1, 0.1]"}, {"liquid.box.origin: got nothing"}},
    {"box_outside",
     {"liquid.box={origin=[0.35, 0], size=[0.1, 0.1]}"},
     {"liquid.box.size", "in x it ends at 0.45"}},
    {"heavy_floats", {"bed.y=floating"}, {"bed.y: got \"floating\"", "below liquid.density"}},
    {"no_water_to_lie_on",
     {"liquid=false", "bed.y=on-water"},
     {"bed.y: got \"on-water\"", "no liquid.level"}},
    {"gate_outside", {"gate.position=0.4"}, {"gate.position: got 0.4", "inside the tank"}},
    {"gate_at_the_wall",
     {"gate.position=0.001"},
     {"gate.position: got 0.001", "a cell of 0.01 m on each side"}},
    {"gate_through_the_bed",
     {"gate.position=0.05"},
     {"gate.position: got 0.05", "which stands from 0 to 0.1 m"}},
    {"bed_of_nothing", {"bed.length=1e-15"}, {"bed.length: got 1e-15", "a bed inside the tank"}},
    {"reference_cells", {"reference.cell=1e-6"}, {"reference.cell: got 1e-06", "at most 100000000"}},
    {"bed_without_solid", {"solid=false"}, {"bed: got [bed] without [solid]"}},
    {"gate_without_bed", {"bed=false", "reference=false", "time.unit=s"}, {"gate: got [gate] without [bed]"}},
    {"reference_without_bed",
     {"bed=false", "gate=false", "time.unit=s"},
     {"reference: got [reference] without [bed]"}},
};
const std::vector<Refused> walls{
    {"lonely_period",
     {"walls.left=periodic"},
     {"walls.left: got \"periodic\"", "walls.right = \"periodic\""}},
    {"open_side", {"walls.left=open"}, {"walls.left: got \"open\"", "only walls.top may be open"}},
    {"all_open", {"walls.all=open"}, {"walls.all: got \"open\"", "only walls.top may be open"}},
    {"no_friction", {"walls.bottom.solid=coulomb"}, {"walls.bottom.solid_friction: got nothing", "required"}},
    {"idle_friction",
     {"walls.bottom.solid_friction=0.2"},
     {"walls.bottom.solid_friction: got 0.2", "only with"}},
    {"no_bumpiness", {"walls.bottom.solid=bumpy"}, {"walls.bottom.bumpiness: got nothing", "required"}},
    {"idle_bumpiness", {"walls.bottom.bumpiness=36"}, {"walls.bottom.bumpiness: got 36", "only with"}},
    {"idle_bump_restitution",
     {"walls.bottom.bump_restitution=0.5"},
     {"walls.bottom.bump_restitution: got 0.5", "only with"}},
    {"overhanging_bumps",
     {"walls.bottom.solid=bumpy", "walls.bottom.bumpiness=91"},
     {"walls.bottom.bumpiness: got 91", "a number in (0, 90] [degrees]"}},
    {"fluid_coulomb", {"walls.bottom.fluid=coulomb"}, {"walls.bottom.fluid: got \"coulomb\""}},
    {"front_in_2d", {"walls.front=slip"}, {"walls.front: got \"slip\"", "no such key in 2D"}},
    {"normal_velocity", {"walls.bottom.velocity=[0, 1]"}, {"walls.bottom.velocity", "normal component 0"}},
    {"part_of_an_open_side",
     {"walls.top.fluid=slip"},
     {"walls.top.fluid: got \"slip\", allowed: nothing beside walls.top = \"open\"",
      "needs both walls.top.fluid and walls.top.solid"}},
    {"part_of_periodic_all",
     {"walls.all=periodic", "tank.gravity=0", "time.unit=s", "walls.top=periodic", "walls.left.solid=slip"},
     {"walls.left.solid: got \"slip\", allowed: nothing beside walls.all = \"periodic\""}},
    {"velocity_of_an_open_side", {"walls.top.velocity=[1, 0]"}, {"walls.top.velocity", "nothing beside"}},
    {"velocity_nobody_feels",
     {"walls.all=slip", "walls.bottom.velocity=[1, 0]"},
     {"walls.bottom.velocity: got [1, 0]", "only where a phase feels it"}},
    {"periodic_along_gravity",
     {"walls.top=periodic", "walls.bottom=periodic"},
     {"walls.bottom: got \"periodic\"", "tank.gravity = 0"}},
    {"inlet_of_all", {"walls.all.inflow=1"}, {"walls.all.inflow: got 1", "of one side"}},
    {"inlet_and_outlet",
     {"walls.left.inflow=1", "walls.left.outflow_pressure=0"},
     {"walls.left.outflow_pressure: got 0", "an inlet or an outlet"}},
    {"inlet_and_wall",
     {"walls.left=slip", "walls.left.inflow=1"},
     {"walls.left: got \"slip\"", "nothing beside walls.left.inflow"}},
    {"backwards", {"walls.left.inflow=-1"}, {"walls.left.inflow: got -1", "a number > 0 [m/s]"}},
    {"fraction_without_inlet",
     {"walls.left.inflow_liquid_share=1"},
     {"walls.left.inflow_liquid_share: got 1", "only with walls.left.inflow"}},
    {"level_without_outlet",
     {"walls.left.outflow_level=0"},
     {"walls.left.outflow_level: got 0", "only with walls.left.outflow_pressure"}},
    {"level_beyond_the_tank",
     {"walls.left.outflow_pressure=0", "walls.left.outflow_level=1"},
     {"walls.left.outflow_level: got 1", "at most the tank's height 0.12 m"}},
    {"no_way_out",
     {"walls.top=slip", "walls.left.inflow=1"},
     {"walls.left.inflow: got 1", "a way out", "outflow_pressure"}},
    {"denser_than_grains",
     {"walls.left.inflow=1", "walls.left.inflow_solid_fraction=0.7"},
     {"walls.left.inflow_solid_fraction: got 0.7", "at most contact.solid_fraction_max = 0.63"}},
    {"inlet_in_2d", {"walls.front.inflow=1"}, {"walls.front.inflow: got 1", "no such key in 2D"}},
    {"inclined_too_far", {"tank.inclination=90"}, {"tank.inclination: got 90", "a number in (-90, 90)"}},
    {"obstacle_beside_cells",
     {"obstacle={x0=[0.2], x1=[0.215], y0=[0], y1=[0.02]}"},
     {"obstacle.x1: got [0.215]", "faces of cells, of 0.01 m", "the nearest is 0.22"}},
    {"obstacle_outside",
     {"obstacle={x0=[0.2], x1=[0.5], y0=[0], y1=[0.02]}"},
     {"obstacle.x1: got [0.5]", "inside the tank of 0.4 m"}},
    {"obstacle_of_nothing",
     {"obstacle={x0=[0.2], x1=[0.2], y0=[0], y1=[0.02]}"},
     {"obstacle.x1: got [0.2]", "each beyond its obstacle.x0"}},
    {"obstacle_in_the_bed",
     {"obstacle={x0=[0.05], x1=[0.06], y0=[0], y1=[0.02]}"},
     {"obstacle.x0: got [0.05]", "beside the bed"}},
    {"obstacle_at_the_gate",
     {"obstacle={x0=[0.1], x1=[0.12], y0=[0], y1=[0.02]}"},
     {"obstacle.x0: got [0.1]", "beside the gate, which stands at 0.1 m"}},
    {"obstacle_at_an_outlet",
     {"walls.right.outflow_pressure=0", "obstacle={x0=[0.38], x1=[0.4], y0=[0], y1=[0.02]}"},
     {"obstacle.x0: got [0.38]", "leave inlets and outlets free"}},
    {"obstacle_across_the_way_out",
     {"walls.left.inflow=0.1", "walls.top=slip", "walls.right.outflow_pressure=0",
      "obstacle={x0=[0.2], x1=[0.22], y0=[0], y1=[0.12]}"},
     {"obstacle.x0: got [0.2]", "leave a way out to what comes in at walls.left"}},
    {"half_an_obstacle",
     {"obstacle={x0=[0.2, 0.3], x1=[0.22], y0=[0, 0], y1=[0.02, 0.02]}"},
     {"obstacle.x1: got [0.22]", "one number for each obstacle, as obstacle.x0 has 2"}},
    {"obstacle_without_height", {"obstacle={x0=[0.2], x1=[0.22], y0=[0]}"}, {"obstacle.y1: got nothing"}},
    {"velocity_of_all", {"walls.all.velocity=[0, 0]"}, {"walls.all.velocity", "of one side"}},
};
const std::vector<Refused> times{
    {"no_end", {"time.end=0"}, {"time.end: got 0, allowed: a number > 0"}},
    {"late_field", {"output.field_times=[0, 11]"}, {"output.field_times: got [0, 11]", "times in [0, 10]"}},
    {"early_field", {"output.field_times=[-1, 2]"}, {"output.field_times: got [-1, 2]", "each >= 0"}},
    {"field_order", {"output.field_times=[2, 1]"}, {"output.field_times", "ascending"}},
    {"field_twice", {"output.field_times=[1, 1]"}, {"output.field_times", "each once"}},
    {"both_kinds",
     {"output.field_times=[1]", "output.field_interval=1"},
     {"either field_times or field_interval"}},
    {"field_interval", {"output.field_interval=11"}, {"output.field_interval: got 11", "time.end"}},
    {"series_too_long", {"output.series_interval=11"}, {"output.series_interval: got 11", "to time.end"}},
    {"series_too_fine", {"output.series_interval=1e-6"}, {"output.series_interval: got 1e-06"}},
    {"unit_without_bed",
     {"bed=false", "gate=false", "reference=false"},
     {"time.unit: got \"column\"", "needs a [bed]"}},
    {"endless_hold", {"time.hold=1e20"}, {"time.hold: got 1e+20", "steps of numerics.dt_max"}},
    {"endless", {"time.end=1e20"}, {"time.end: got 1e+20", "steps of numerics.dt_max"}},
    {"hold_without_gate", {"gate=false", "time.hold=0.1"}, {"time.hold: got 0.1", "no [gate]"}},
    {"gate_release_without_gate",
     {"gate=false", "reference.release=gate"},
     {"reference.release: got \"gate\""}},
};

const auto name_of = [](const auto& info) { return info.param.what; };
INSTANTIATE_TEST_SUITE_P(Values, Overrides, ::testing::ValuesIn(values), name_of);
INSTANTIATE_TEST_SUITE_P(Keys, Overrides, ::testing::ValuesIn(keys), name_of);
INSTANTIATE_TEST_SUITE_P(Geometry, Overrides, ::testing::ValuesIn(geometry), name_of);
INSTANTIATE_TEST_SUITE_P(Walls, Overrides, ::testing::ValuesIn(walls), name_of);
INSTANTIATE_TEST_SUITE_P(Times, Overrides, ::testing::ValuesIn(times), name_of);

// Replaces the first `from` of the small case.
std::string edited(const std::string& from, const std::string& to) {
  std::string text(small_case);
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CaseErrors, NameTheLineOfAValue) {
  EXPECT_EQ(refusal_of(edited("friction = 0.4", "friction = -0.4")),
            "small.toml:20:12: solid.friction: got -0.4, allowed: a number >= 0");
}

TEST(CaseErrors, NameTheLineOfAnUnknownKeyAndTable) {
  EXPECT_EQ(refusal_of(edited("friction = 0.4", "frction = 0.4")),
            "small.toml:20:11: solid.frction: unknown key (got 0.4), did you mean solid.friction?");
  EXPECT_EQ(refusal_of(edited("[gate]\nspeed = 1.0", "[gait]")).substr(0, 35),
            "small.toml:25:1: gait: unknown key ");
}

TEST(CaseErrors, NameTheTableThatLacksAKey) {
  const std::string message = refusal_of(edited("friction = 0.4\n", ""));
  EXPECT_EQ(message.substr(0, 45), "small.toml:17:1: solid.friction: got nothing,") << message;
}

TEST(CaseErrors, NameTheFileThatLacksATable) {
  const std::string message = refusal_of(edited("[grid]\ndx = 0.01\n", ""));
  EXPECT_EQ(message.substr(0, 32), "small.toml: grid.dx: got nothing") << message;
}

TEST(CaseErrors, NameTheLineOfASyntaxError) {
  EXPECT_EQ(refusal_of(edited("level = 0.07", "level = = 0.07")).substr(0, 26), "small.toml:16:9: not TOML:");
  EXPECT_EQ(refusal_of(edited("level = 0.07", "level = 0.07\nlevel = 0.08")).substr(0, 26),
            "small.toml:17:9: not TOML:");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(CaseErrors, NameAllFaultsInTheOrderOfTheText) {
  std::string text = edited("dx = 0.01", "dx = 0.03");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("top = \"open\"", "left = \"open\"");
  replace("level = 0.07", "level = 0.7");
  replace("friction = 0.4", "frction = 0.4");
  replace("solid_fraction = 0.57", "solid_fraction = 0.7");
  replace("end = 10", "end = \"late\"");
  replace("preset = \"paper\"", "preset = \"papers\"");
  const std::vector<std::string> overrides{"numerics.dt_max=0.5", "numerics.dt_min=1"};
  const auto lines = lines_of(refusal_of(text, overrides));
  const std::vector<std::string> expected{
      "--set: numerics.dt_min: got 1,",          "small.toml:7:6: grid.dx: got 0.03",
      "small.toml:9:8: walls.left: got",         "small.toml:16:9: liquid.level: got 0.7",
      "small.toml:20:11: solid.frction:",        "small.toml:24:18: bed.solid_fraction: got 0.7",
      "small.toml:28:7: time.end: got \"late\"", "small.toml:36:10: model.preset: got \"papers\"",
  };
  ASSERT_EQ(lines.size(), expected.size()) << refusal_of(text, overrides);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_TRUE(lines[i].starts_with(expected[i])) << lines[i];
}

TEST(CaseErrors, DoNotFollowFromOneAnother) {
  // Whatever depends on the tank is left unsaid until the tank is known.
  EXPECT_EQ(lines_of(refusal_of(small_case, {"tank.size=[0.4, -1]"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"solid=3"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"gate=3"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"scene.dimensions=7"})).size(), 1U);
  // What a preset decides is not known without it; nor is a longest step without the scene.
  EXPECT_EQ(
      lines_of(refusal_of(small_case, {"model.preset=no", "contact.critical_solid_fraction=0.5"})).size(),
      1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"bed.height=-1", "numerics.dt_min=1"})).size(), 1U);
}

TEST(CaseErrors, AllBadOverridesAreNamed) {
  EXPECT_EQ(lines_of(refusal_of(small_case, {"dx", "grid.dx="})).size(), 2U);
}

TEST(CaseErrors, AreOfBoundedLengthAndNumber) {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "odd_key_number_" + std::to_string(i) + " = 1\n";
  const std::string refusal = refusal_of(std::string(small_case) + many);
  const auto lines = lines_of(refusal);
  EXPECT_LE(refusal.size(), 2000U);
  EXPECT_GT(lines.size(), 2U);
  EXPECT_EQ(lines.back(), "and " + std::to_string(1000 - (lines.size() - 1)) + " more faults");
  const std::string longest(100000, 'x');
  for (const std::string& text :
       {edited("[gate]", "[gate]\n" + longest + " = 1"),
        edited("name = \"small\"", "name = \"" + longest + '"'), edited("[gate]", "[" + longest + "]"),
        edited("level = 0.07", "level = [[" + longest + "]]"),
        edited("end = 10", "end = \"" + longest + '"')}) {
    EXPECT_LT(refusal_of(text).size(), 1000U);
    EXPECT_NE(refusal_of(text), "");
  }
}

TEST(CaseErrors, ShowWhatCannotBePrintedEscaped) {
  const std::string name = edited("friction = 0.4", "friction = 0.4\n\"a\\n\\u001b[2J\\u202e\" = 1");
  const std::string message = refusal_of(name);
  EXPECT_NE(message.find("solid.\"a\\u000A\\u001B[2J\\u202E\": unknown key"), std::string::npos) << message;
  const std::string value = refusal_of(edited("end = 10", "end = \"\\u009b31m\\u2028\""));
  EXPECT_NE(value.find("got \"\\u009B31m\\u2028\""), std::string::npos) << value;
  EXPECT_NE(refusal([] { parse_scene("x", "a\nb.toml"); }).find("a\\u000Ab.toml:1:"), std::string::npos);
  EXPECT_NE(refusal_of(small_case, {"grid.dx=\xff\x1b"}).find("grid.dx: got \\xFF\\u001B"),
            std::string::npos);
}

TEST(CaseErrors, AQuotedPathIsOneNameAndNoKey) {
  EXPECT_NE(refusal_of("\"solid.friction\" = 0.3\n" + std::string(small_case)).find("unknown key"),
            std::string::npos);
}

TEST(CaseErrors, RefuseAnEmptyFile) {
  EXPECT_NE(refusal_of("").find("scene.name: got nothing"), std::string::npos);
}

}  // namespace
}  // namespace granvof::test
