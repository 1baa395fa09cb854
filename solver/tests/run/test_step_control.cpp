// Every limit of the time step, one at a time; the start of a scene; and what the monitors notice.
#include <gtest/gtest.h>

#include "solver/run/initial_state.hpp"
#include "solver/run/monitors.hpp"
#include "solver/run/step_control.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::column_scene;

struct Control {
  explicit Control(const std::vector<std::string>& overrides = {})
      : scene(column_scene(overrides)),
        grid(scene),
        boundary(grid),
        state(initial_state(grid, scene, boundary)),
        law(scene),
        control(grid, scene, law) {
    state.time = 1.0;  // the gate is up
    control.accepted(scene.numerics.dt_max);
  }
  std::ptrdiff_t at(int i, int j) const { return grid.cells.index(i, j, 0); }
  Scene scene;
  Grid grid;
  Boundary boundary;
  State state;
  closures::SolidLaw law;
  StepControl control;
};

TEST(StepControl, LongestStepAndGrowth) {
  Control c;
  EXPECT_DOUBLE_EQ(c.control.next(c.state), c.scene.numerics.dt_max);
  c.control.accepted(1e-4);
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 1.2e-4);
  EXPECT_DOUBLE_EQ(c.control.last(), 1e-4);
  c.control.restore(2e-4);
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 2.4e-4);
  EXPECT_DOUBLE_EQ(c.control.after_refusal(1e-3), 4e-4);
  const StepControl fresh(c.grid, c.scene, c.law);
  EXPECT_LT(fresh.next(c.state), 0.5 * c.scene.numerics.dt_max);  // a run begins carefully
}

TEST(StepControl, CourantNumberOfEitherPhase) {
  Control c({"numerics.cfl=0.3"});
  c.state.u_c[1][c.at(10, 5)] = -2.0;
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.3 * 0.01 / 2.0);
  c.state.u_s[0][c.at(2, 2)] = 3.0;  // among grains
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.3 * 0.01 / 3.0);
  c.state.u_s[0][c.at(12, 2)] = 50.0;  // where there are none it counts for nothing
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.3 * 0.01 / 3.0);
  c.state.u_c[1][c.at(3, 8)] = 4.0;  // on the open top
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.3 * 0.01 / 4.0);
}

// A thousandth of grains is next to none beside a bed, and all there is of a dilute cloud.
TEST(StepControl, GrainsCountByWhatTheirBedHas) {
  Control c({"numerics.cfl=0.3", "bed.solid_fraction=3e-4"});
  c.state.u_s[0][c.at(2, 2)] = 3.0;
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.3 * 0.01 / 3.0);
}

TEST(StepControl, GateAndHold) {
  Control c({"gate.speed=2", "time.hold=0.01"});
  c.state.time = 0.0;
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.5 * 0.01 / 2.0);
  c.state.time = 0.08 / 2.0 + 1e-6;  // it is out of the tank
  EXPECT_DOUBLE_EQ(c.control.next(c.state), c.scene.numerics.dt_max);
  c.state.time = -1e-3;  // meets the release exactly
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 1e-3);
  // without a last step so short that the next ones would have to grow from it
  const double longest = c.scene.numerics.dt_max;
  c.state.time = -1.001 * longest;
  EXPECT_DOUBLE_EQ(c.control.next(c.state), 0.5 * 1.001 * longest);
  c.state.time += c.control.next(c.state);
  c.state.time += c.control.next(c.state);
  EXPECT_EQ(c.state.time, 0.0);
}

TEST(InitialState, BedLiquidAndHydrostaticPressure) {
  const Control c({"time.hold=0.02"});
  EXPECT_EQ(initial_state(c.grid, c.scene, c.boundary).time, -0.02);
  EXPECT_DOUBLE_EQ(c.state.f_s[c.at(4, 3)], 0.57);
  EXPECT_EQ(c.state.f_s[c.at(5, 3)], 0.0);
  EXPECT_EQ(c.state.f_s[c.at(4, 4)], 0.0);
  EXPECT_EQ(c.state.phi[c.at(4, 3)], 1.0);
  EXPECT_EQ(c.state.phi[c.at(5, 3)], 0.0);
  EXPECT_NEAR(c.state.alpha[c.at(4, 3)], 1.0, 1e-12);
  EXPECT_NEAR(c.state.alpha[c.at(9, 5)], 1.0, 1e-12);
  EXPECT_NEAR(c.state.alpha[c.at(9, 6)], 0.0, 1e-12);
  // two cells of gas, half a cell either side of the surface, then water, the bed's pores included
  const double surface = 9.81 * (0.015 * 1.0 + 0.01 * 500.5);
  EXPECT_NEAR(c.state.p_c[c.at(9, 5)], surface, 1e-9);
  for (int i : {2, 9}) EXPECT_NEAR(c.state.p_c[c.at(i, 0)], surface + 9.81 * 1000.0 * 0.05, 1e-9);
}

TEST(InitialState, PartialCellsHoldTheirShare) {
  const Control c({"bed.height=0.043", "bed.length=0.055", "liquid.level=0.0625"});
  EXPECT_NEAR(c.state.f_s[c.at(2, 4)], 0.57 * 0.3, 1e-12);
  EXPECT_NEAR(c.state.f_s[c.at(5, 2)], 0.57 * 0.5, 1e-12);
  EXPECT_NEAR(c.state.f_s[c.at(5, 4)], 0.57 * 0.15, 1e-12);
  EXPECT_NEAR(c.state.alpha[c.at(9, 6)], 0.25, 1e-12);
}

TEST(Monitors, NoticeWhatIsNotFinite) {
  const Control c;
  const Monitors monitors(c.grid, c.scene, c.state);
  EXPECT_EQ(monitors.not_finite(c.state), "");
  const auto expect_noticed = [&](const char* name, auto&& field_of) {
    for (double bad : {std::nan(""), -std::nan(""), std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()})
      for (std::ptrdiff_t where : {c.at(0, 0), c.at(7, 3), c.at(15, 7)}) {
        State s = c.state;
        field_of(s)[where] = bad;
        EXPECT_EQ(monitors.not_finite(s), name) << bad;
      }
  };
  for (const CellQuantity& q : cell_quantities)
    expect_noticed(q.name, [&](State& s) -> Field& { return s.*q.field; });
  for (const FaceQuantity& q : face_quantities)
    for (int d = 0; d < 2; ++d) expect_noticed(q.name, [&](State& s) -> Field& { return (s.*q.field)[d]; });
  for (const EnergyTerm& term : energy_terms) {
    State s = c.state;
    s.energy.*term.value = std::nan("");
    EXPECT_EQ(monitors.not_finite(s), term.name);
  }
}

TEST(Monitors, VolumesAndTheirErrors) {
  Control c;
  Monitors monitors(c.grid, c.scene, c.state);
  const auto start = monitors.values();
  EXPECT_NEAR(start.solid_volume, 0.57 * 0.05 * 0.04 * c.scene.tank[2], 1e-12);
  EXPECT_NEAR(start.liquid_volume, (0.16 * 0.06 - 0.57 * 0.05 * 0.04) * c.scene.tank[2], 1e-12);
  monitors.update(c.state, 0.0, 0.0);
  EXPECT_LT(monitors.solid_volume_error(), 1e-15);
  c.state.f_s[c.at(1, 1)] += 0.01;  // displaces liquid where alpha = 1
  monitors.update(c.state, 0.0, 0.0);
  EXPECT_NEAR(monitors.solid_volume_error(), 0.01 / (0.57 * 20.0), 1e-9);
  EXPECT_NEAR(monitors.liquid_volume_error(), 0.01 / (96.0 - 0.57 * 20.0), 1e-9);
  EXPECT_NEAR(monitors.solid_fraction_max(), 0.58, 1e-12);
  c.state.f_s[c.at(1, 1)] -= 0.01;
  c.state.alpha[c.at(9, 3)] = 0.5;
  monitors.update(c.state, 0.5 * c.grid.cell_volume, 0.0);  // it left through the top: no error
  EXPECT_NEAR(monitors.solid_volume_error(), 0.01 / (0.57 * 20.0), 1e-9);  // the largest so far stays
  EXPECT_NEAR(monitors.liquid_volume_error(), 0.01 / (96.0 - 0.57 * 20.0), 1e-9);
}

}  // namespace
}  // namespace granvof
