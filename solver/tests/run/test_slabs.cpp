// A tank that is cut into slabs, a process each, is the tank of one process (cut_runs.hpp).
#include "solver/tests/run/cut_runs.hpp"

namespace granvof {
namespace {

using test::Outcome;
using test::outcome_of;
using test::saved;
using test::take_steps;
using test::Variant;
using test::with;

constexpr int steps = 5;

Scene scene_of(const Variant& variant) {
  return test::column_scene(variant.overrides);
}

// Of 2, 3, 4, 6 and 8 processes those that the tank can be cut for.
std::vector<int> numbers_of_processes(const Scene& scene) {
  std::vector<int> numbers;
  for (const int processes : {2, 3, 4, 6, 8}) {
    try {
      check_cut(scene, processes);
      numbers.push_back(processes);
    } catch (const CaseError&) {
      EXPECT_GT(processes, 4);
    }
  }
  return numbers;
}

// What the pressure solver leaves is closed along other ways in slabs.
std::vector<Variant> tightly(std::vector<Variant> variants) {
  for (Variant& v : variants)
    v.overrides.insert(v.overrides.end(), test::tightly_solved.begin(), test::tightly_solved.end());
  return variants;
}

class Slabs : public ::testing::TestWithParam<Variant> {};

TEST_P(Slabs, BeginAsTheTankOfOneProcess) {
  const Scene scene = scene_of(GetParam());
  Outcome one;
  with(1, scene, [&](TimeLoop& loop) { one = outcome_of(loop); });
  for (const int processes : {2, 3})
    with(processes, scene, [&](TimeLoop& loop) {
      const Outcome many = outcome_of(loop);
      for (const auto& [name, values] : one.fields) EXPECT_EQ(values, many.fields.at(name)) << name;
    });
}

TEST_P(Slabs, TakeTheStepsOfOneProcess) {
  const Scene scene = scene_of(GetParam());
  test::expect_the_steps_of_one(scene, numbers_of_processes(scene), steps);
}

// Where everything moves and differs from cell to cell, what a slab does not know of its neighbours shows.
TEST_P(Slabs, TakeAStepFromAnyStateAsOneProcess) {
  const Scene scene = scene_of(tightly({GetParam()}).front());
  Outcome any;
  with(1, scene, [&](TimeLoop& loop) { any = test::shaken(scene, outcome_of(loop)); });
  Outcome one;
  for (const int processes : {1, 2, 3})
    with(processes, scene, [&](TimeLoop& loop) {
      loop.restore(saved(any));
      take_steps(loop, 1);
      const Outcome after = outcome_of(loop);
      if (processes == 1) one = after;
      test::expect_alike(scene, one, after, processes);
    });
}

TEST_P(Slabs, TakeBackAStep) {
  const Scene scene = scene_of(GetParam());
  with(3, scene, [&](TimeLoop& loop) {
    take_steps(loop, 1);
    const Outcome before = outcome_of(loop);
    take_steps(loop, 1);
    EXPECT_NE(outcome_of(loop).fields, before.fields);
    loop.step_back();
    EXPECT_EQ(outcome_of(loop).fields, before.fields);
    EXPECT_EQ(outcome_of(loop).numbers, before.numbers);
  });
}

TEST_P(Slabs, AreRestoredFromAnyNumberOfProcesses) {
  const Scene scene = scene_of(GetParam());
  Outcome first;
  with(1, scene, [&](TimeLoop& loop) {
    take_steps(loop, 2);
    first = outcome_of(loop);
  });
  Outcome last = first;
  for (const int processes : {3, 2, 1})
    with(processes, scene, [&](TimeLoop& loop) {
      loop.restore(saved(last));
      EXPECT_EQ(loop.counters().steps, 7);
      last = outcome_of(loop);
      EXPECT_EQ(last.fields, first.fields) << processes << " processes";
      EXPECT_EQ(last.numbers, first.numbers) << processes << " processes";
      take_steps(loop, 1);
      EXPECT_NE(outcome_of(loop).fields, first.fields);
    });
}

// Without grains, with some in one slab only, across seams, on a periodic seam.
INSTANTIATE_TEST_SUITE_P(
    Scenes, Slabs,
    ::testing::Values(
        Variant{"dam_break_without_grains", {"bed.height=1e-9", "gate.speed=100"}}, Variant{"paper", {}},
        Variant{"sourced", {"model.preset=sourced"}}, Variant{"advised", {"model.preset=advised"}},
        Variant{"flow_over_all_slabs", {"gate.speed=100", "bed.length=0.1"}},
        Variant{"plic_under_a_lid", {"walls.top=no-slip", "numerics.interface_scheme=plic", "gate=false"}},
        Variant{"behind_a_gate_under_a_lid", {"walls.top=no-slip", "gate.speed=0.5"}},
        Variant{"moving_bumpy_floor_in_periodic_ends",
                {"gate=false", "walls.left=periodic", "walls.right=periodic", "walls.bottom.solid=bumpy",
                 "walls.bottom.bumpiness=36", "walls.bottom.velocity=[0.1, 0]"}},
        Variant{"three_dimensions_cut_across_z", {"scene.dimensions=3", "tank.size=[0.16, 0.08, 0.16]"}},
        Variant{"three_dimensions_cut_across_x", {"scene.dimensions=3", "tank.size=[0.16, 0.08, 0.04]"}},
        Variant{"long_enough_for_eight", {"tank.size=[0.32, 0.08]", "model.preset=advised"}},
        Variant{"on_a_slope", {"tank.inclination=10"}}, Variant{"honey", {"liquid.viscosity=2"}},
        Variant{"explicit_contacts", {"numerics.contact_pressure=explicit"}},
        Variant{"coulomb_walls_at_the_ends",
                {"walls.left.solid=coulomb", "walls.left.solid_friction=0.2", "walls.right.solid=coulomb",
                 "walls.right.solid_friction=0.2", "gate=false", "bed.length=0.16", "model.preset=advised"}},
        Variant{"a_wall_that_moves_at_one_end", {"walls.left.velocity=[0, 0.1]", "walls.left.solid=slip"}}),
    test::name_of);

std::vector<std::string> with_obstacle(const std::array<std::string, 4>& box, std::vector<std::string> more) {
  const std::array<const char*, 4> keys{"x0", "x1", "y0", "y1"};
  for (std::size_t i = 0; i < 4; ++i) more.push_back(fmt::format("obstacle.{}=[{}]", keys[i], box[i]));
  return more;
}

// Cuts of the 16 columns: 8; 5 and 11; 4, 8 and 12.
INSTANTIATE_TEST_SUITE_P(
    WithObstacles, Slabs,
    ::testing::ValuesIn(tightly(
        {Variant{"over_a_cut", with_obstacle({"0.07", "0.09", "0", "0.02"}, {"gate.speed=100"})},
         Variant{"under_the_bed",
                 with_obstacle({"0.03", "0.06", "0", "0.02"},
                               {"model.preset=advised", "bed.length=0.1", "bed.y=0.02", "gate=false"})},
         Variant{"two_that_end_at_cuts",
                 with_obstacle({"0.08, 0.05", "0.11, 0.08", "0.03, 0.01", "0.05, 0.02"},
                               {"numerics.interface_scheme=plic", "gate=false"})},
         Variant{"a_plate_that_parts_slabs",
                 with_obstacle({"0.03", "0.13", "0.04", "0.05"},
                               {"walls.top=no-slip", "gate=false", "liquid.level=0.055"})},
         Variant{"chambers_of_their_own", with_obstacle({"0.06, 0.11", "0.07, 0.12", "0, 0", "0.08, 0.08"},
                                                        {"walls.top=no-slip", "gate=false"})},
         Variant{"on_a_periodic_seam",
                 with_obstacle({"0, 0.15", "0.01, 0.16", "0.01, 0.01", "0.03, 0.03"},
                               {"walls.left=periodic", "walls.right=periodic", "bed.x=0.03", "gate=false",
                                "numerics.interface_scheme=plic"})},
         Variant{"on_a_slope_with_a_gate",
                 with_obstacle({"0.10", "0.12", "0", "0.03"}, {"tank.inclination=10", "gate.speed=0.5"})},
         Variant{"honey_over_a_step", with_obstacle({"0.07", "0.12", "0", "0.02"}, {"liquid.viscosity=2"})},
         Variant{"in_three_dimensions_across_z",
                 with_obstacle({"0.06", "0.09", "0", "0.03"},
                               {"scene.dimensions=3", "tank.size=[0.16, 0.08, 0.16]", "obstacle.z0=[0.06]",
                                "obstacle.z1=[0.11]"})},
         Variant{"in_three_dimensions_across_x",
                 with_obstacle({"0.07", "0.12", "0.01", "0.03"},
                               {"scene.dimensions=3", "tank.size=[0.16, 0.08, 0.04]", "obstacle.z0=[0.01]",
                                "obstacle.z1=[0.03]", "numerics.interface_scheme=plic"})}})),
    test::name_of);

// Through ends, which are one process's each, and through sides that every process has a part of.
INSTANTIATE_TEST_SUITE_P(
    FlowThrough, Slabs,
    ::testing::ValuesIn(tightly(
        {Variant{"from_left_to_right",
                 {"gate=false", "walls.top=slip", "walls.left.inflow=0.1", "walls.right.outflow_pressure=0",
                  "walls.right.outflow_level=0.06"}},
         Variant{"honey_from_right_to_left",
                 {"gate=false", "walls.top=slip", "walls.right.inflow=0.1", "walls.left.outflow_pressure=0",
                  "walls.left.outflow_level=0.06", "liquid.viscosity=2"}},
         Variant{"of_grains_out_and_in",
                 {"gate=false", "walls.top=open", "walls.left.inflow=0.1",
                  "walls.left.inflow_solid_fraction=0.3", "walls.right.outflow_pressure=0", "bed.length=0.16",
                  "bed.solid_fraction=0.4", "model.preset=sourced"}},
         Variant{"out_of_the_floor",
                 {"gate=false", "walls.bottom.outflow_pressure=0", "model.preset=advised"}},
         Variant{"up_through_the_bed",
                 {"gate=false", "bed.length=0.16", "walls.bottom.inflow=0.01", "model.preset=advised"}},
         Variant{"past_a_step_on_a_slope",
                 with_obstacle({"0.07", "0.11", "0", "0.02"},
                               {"gate=false", "tank.inclination=5", "walls.left.inflow=0.1",
                                "walls.right.outflow_pressure=0", "walls.right.outflow_level=0.03",
                                "numerics.interface_scheme=plic"})},
         Variant{"along_z_in_three_dimensions",
                 {"gate=false", "scene.dimensions=3", "tank.size=[0.16, 0.08, 0.16]",
                  "walls.front.inflow=0.1", "walls.back.outflow_pressure=0"}}})),
    test::name_of);

void expect_refused(const std::vector<std::string>& overrides, int processes, const std::string& why) {
  try {
    check_cut(test::column_scene(overrides), processes);
    ADD_FAILURE() << "not refused";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(CutOfATank, IsRefusedWhereItCannotBe) {
  EXPECT_NO_THROW(check_cut(test::column_scene(), 4));
  expect_refused({}, 5, "grid.cells: got 16 along x and 5 processes, allowed: at most 4 processes");
}

}  // namespace
}  // namespace granvof
