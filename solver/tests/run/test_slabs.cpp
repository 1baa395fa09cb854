// A tank that is cut into slabs, a process each, is the tank of one process.
//
// Only the order in which sums are added up differs, and the multigrid of friction, which keeps to no box of
// grains along the cut: fields agree to what the solvers' tolerances leave.
#include <gtest/gtest.h>

#include "solver/run/cut.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using test::Variant;

constexpr int steps = 5;
constexpr double tolerance = 1e-6;  // of the largest value of a field
// Of the scene's own scales: what the friction solver leaves of a velocity.
constexpr double left_by_solvers = 1e-9;

Scene scene_of(const Variant& variant) {
  return test::column_scene(variant.overrides);
}

struct Outcome {
  std::map<std::string, std::vector<double>> fields;  // ghosts included
  std::map<std::string, double> numbers;
  double time = 0.0;
};

Outcome outcome_of(TimeLoop& loop) {
  Outcome all;
  const CheckpointView view = loop.checkpoint({});
  for (const auto& [name, values] : view.arrays) all.fields[name].assign(values.begin(), values.end());
  all.numbers.insert(view.scalars.begin(), view.scalars.end());
  all.time = view.time;
  return all;
}

Checkpoint saved(const Outcome& all) {
  Checkpoint c;
  c.time = all.time;
  c.arrays = all.fields;
  c.scalars.insert(all.numbers.begin(), all.numbers.end());
  for (const char* name : {"steps", "refused_steps", "newton", "linear", "friction", "unconverged_friction"})
    c.counters[name] = 7;
  return c;
}

void take_steps(TimeLoop& loop, int n) {
  for (int i = 0; i < n; ++i)
    if (const auto stuck = loop.advance()) throw std::runtime_error(stuck->reason);
}

// lead(loop) in the lowest of so many processes that share the tank; the others follow.
template <typename Lead>
void with(int processes, const Scene& scene, Lead&& lead) {
  if (processes == 1) {
    TimeLoop loop(scene);
    return lead(loop);
  }
  test::Team team(processes, test::Boxes::slabs);
  ASSERT_NO_THROW(team.run([&](int rank, const Communicator& communicator) {
    TimeLoop loop(scene, &communicator);
    if (rank > 0) {
      EXPECT_EQ(loop.follow(), 5);
      return;
    }
    lead(loop);
    loop.dismiss(5);
  }));
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::fabs(v));
  return most;
}

// What a field's values are measured by: the scene's velocity, pressure, 1.
double scale_of(const Scene& scene, const std::string& field) {
  const Scales scales = scales_of(scene);
  if (field.starts_with("u_")) return scales.velocity;
  if (field.starts_with("p_")) return scales.pressure;
  return field == "theta" ? scales.velocity * scales.velocity : 1.0;
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
  Outcome one;
  with(1, scene, [&](TimeLoop& loop) {
    take_steps(loop, steps);
    one = outcome_of(loop);
  });
  EXPECT_GT(one.numbers.at("energy_kinetic"), 0.0);
  for (const int processes : numbers_of_processes(scene))
    with(processes, scene, [&](TimeLoop& loop) {
      take_steps(loop, steps);
      const Outcome many = outcome_of(loop);
      for (const auto& [name, values] : one.fields) {
        const double size = largest(values);
        double off = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i)
          off = std::max(off, std::fabs(values[i] - many.fields.at(name)[i]));
        EXPECT_LE(off, tolerance * size + left_by_solvers * scale_of(scene, name))
            << name << ", " << processes << " processes";
      }
      for (const auto& [name, value] : one.numbers)
        EXPECT_NEAR(many.numbers.at(name), value,
                    tolerance * (std::fabs(value) + 1e-3 * one.numbers.at("energy_potential")))
            << name << ", " << processes << " processes";
      EXPECT_LE(many.numbers.at("liquid_error"), 1e-12);
      EXPECT_LE(many.numbers.at("solid_error"), 1e-12);
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
        Variant{"explicit_contacts", {"numerics.contact_pressure=explicit"}}),
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
  const std::vector<std::string> step{"obstacle.x0=[0.12]", "obstacle.x1=[0.14]", "obstacle.y0=[0]",
                                      "obstacle.y1=[0.02]"};
  EXPECT_NO_THROW(check_cut(test::column_scene(step), 1));
  expect_refused(step, 2, "obstacle: got 1 of them and 2 processes, allowed: one process");
  expect_refused({"gate=false", "walls.top=slip", "walls.left.inflow=0.1", "walls.right.outflow_pressure=0",
                  "walls.right.outflow_level=0.06"},
                 2, "walls: got an inlet or an outlet and 2 processes, allowed: one process");
}

}  // namespace
}  // namespace granvof
