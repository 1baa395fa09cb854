// Inlets and outlets: what comes in and leaves is accounted, and flows as theory has it.
#include <cmath>

#include <fmt/format.h>

#include "solver/closures/drag/drag.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/run/alarms.hpp"
#include "solver/run/monitors.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::Simulation;

constexpr std::string_view tolerances = "[numerics]\nvolume_tolerance = 1e-10\nlinear_tolerance = 1e-8\n";

Scene channel(std::vector<std::string> overrides) {
  overrides.emplace_back("solid.diameter=2e-3");
  return test::small_tank("channel", "size = [0.12, 0.04]", 0.04,
                          std::string(R"([walls]
all = "slip"
left = { inflow = 0.1 }
right = { outflow_pressure = 0 }
)")
                              .append(tolerances),
                          overrides);
}

struct Account {
  explicit Account(Simulation& run)
      : run_(run), monitors(run.grid, run.scene, run.now), start(run.now.energy) {}
  void until(double time) {
    run_.until(time, [&] {
      monitors.update(run_.now, run_.last.liquid_left, run_.last.solid_left);
      liquid_left += run_.last.liquid_left;
      solid_left += run_.last.solid_left;
    });
  }

 private:
  Simulation& run_;

 public:
  Monitors monitors;
  EnergyTerms start;
  double liquid_left = 0.0, solid_left = 0.0;
};

struct Way {
  const char* walls;
  int axis;
  double speed;
};

class Plug : public ::testing::TestWithParam<Way> {
 protected:
  // Largest difference from a plug [m/s].
  static double off(const Simulation& run) {
    const Way way = GetParam();
    const double *along = run.now.u_c[way.axis].data(), *across = run.now.u_c[1 - way.axis].data();
    const double slower = max_over(run.grid.cells, run.grid.flux_faces(way.axis), 0.0,
                                   [=](std::ptrdiff_t c) { return std::fabs(along[c] - way.speed); });
    return max_over(run.grid.cells, run.grid.inner_faces(1 - way.axis), slower,
                    [=](std::ptrdiff_t c) { return std::fabs(across[c]); });
  }
};

// Between slip walls what comes in goes through as a plug, along every axis and both ways, from the first
// step on.
TEST_P(Plug, GoesThrough) {
  Simulation run(
      test::small_tank("plug", "size = [0.06, 0.06]", 0.06,
                       std::string("[walls]\nall = \"slip\"\n").append(GetParam().walls).append(tolerances),
                       {"solid=false", "time.end=10"}));
  Account account(run);
  run.advance();
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(off(run), 1e-6);
  account.until(1.0);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(off(run), 1e-6);
  EXPECT_LT(account.monitors.liquid_volume_error(), 1e-12);
  EXPECT_NEAR(account.liquid_left, 0.0, 1e-9);
  EXPECT_LT(std::fabs(run.now.energy.residual),
            1e-9 * energy_turnover(run.scene, account.start, run.now.energy));
}

INSTANTIATE_TEST_SUITE_P(
    Ways, Plug,
    ::testing::Values(Way{"left = { inflow = 0.1 }\nright = { outflow_pressure = 0 }\n", 0, 0.1},
                      Way{"right = { inflow = 0.1 }\nleft = { outflow_pressure = 0 }\n", 0, -0.1},
                      Way{"bottom = { inflow = 0.1 }\ntop = { outflow_pressure = 0 }\n", 1, 0.1},
                      Way{"top = { inflow = 0.1 }\nbottom = { outflow_pressure = 0 }\n", 1, -0.1}));

// Water comes into a channel of gas: what has come in is there, whatever it does there.
TEST(Volume, OfWhatComesInIsThere) {
  for (const char* scheme : {"cicsam", "plic", "upwind"}) {
    Simulation run(
        channel({"walls.left.inflow=0.2", "walls.left.inflow_liquid_share=0.5", "liquid.level=0.01",
                 "walls.right.outflow_level=0", std::string("numerics.interface_scheme=") + scheme}));
    Account account(run);
    account.until(0.4);
    ASSERT_FALSE(HasFatalFailure()) << scheme;
    EXPECT_LT(account.monitors.liquid_volume_error(), 1e-12) << scheme;
    const double given = 0.2 * 0.5 * 0.04 * 0.4;
    EXPECT_GT(account.monitors.liquid_volume(run.now), 0.012 * 0.1) << scheme;
    EXPECT_LT(account.liquid_left, 0.0) << scheme;  // more has come in than has left
    EXPECT_GT(account.liquid_left, -given * 1.001) << scheme;
    EXPECT_LT(std::fabs(run.now.energy.residual),
              0.01 * energy_turnover(run.scene, account.start, run.now.energy))
        << scheme;
  }
}

// Water at rest behind an outlet whose level is its own stays.
TEST(Outlet, HoldsAPoolOfItsLevel) {
  Simulation run(channel({"walls.left=slip", "liquid.level=0.02", "walls.right.outflow_level=0.02"}));
  run.until(0.5);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(run.fastest(run.now.u_c), 1e-9);
}

// Of a lower level it drains the pool, and the potential energy that leaves is accounted.
TEST(Outlet, DrainsAPoolToItsLevel) {
  Simulation run(channel({"walls.left=slip", "liquid.level=0.03", "walls.right.outflow_level=0.02",
                          "walls.top=open", "liquid.viscosity=2"}));
  Account account(run);
  const double before = account.monitors.liquid_volume(run.now);
  account.until(5.0);
  ASSERT_FALSE(HasFatalFailure());
  const double after = account.monitors.liquid_volume(run.now);
  EXPECT_NEAR(after, 0.12 * 0.02, 0.02 * after);
  EXPECT_NEAR(account.liquid_left, before - after, 1e-10 * before);
  // At least the weight of what left, at the height of its middle, less what it was given by the pressure
  // there.
  const EnergyTerms& e = run.now.energy;
  EXPECT_LT(std::fabs(e.residual), 0.01 * energy_turnover(run.scene, account.start, e));
}

// Of a higher level it fills a tank that is all but empty: what flows back is water up to that level. With
// what stands inside gas came in, at 33 m/s under the pressure of the water.
TEST(Outlet, FillsAPoolToItsLevel) {
  for (const char* scheme : {"cicsam", "plic"}) {  // upwind smears the surface out of the tank
    Simulation run(
        channel({"walls.left=slip", "liquid.level=0.001", "walls.right.outflow_level=0.021", "walls.top=open",
                 "liquid.viscosity=2", std::string("numerics.interface_scheme=") + scheme}));
    Account account(run);
    const double before = account.monitors.liquid_volume(run.now);
    account.until(9.0);
    ASSERT_FALSE(HasFatalFailure()) << scheme;
    const double after = account.monitors.liquid_volume(run.now);
    EXPECT_NEAR(after, 0.12 * 0.021, 0.02 * after) << scheme;  // it still swings
    EXPECT_NEAR(account.liquid_left, before - after, 1e-10 * after) << scheme;
    const EnergyTerms& e = run.now.energy;
    EXPECT_LT(std::fabs(e.residual), 0.01 * energy_turnover(run.scene, account.start, e)) << scheme;
  }
}

// Viscous flow between plates from an inlet becomes Poiseuille's, and its pressure drop with it.
TEST(Plates, TurnAPlugIntoAParabola) {
  Simulation run(
      channel({"walls.all=no-slip", "tank.size=[0.12, 0.02]", "grid.dx=0.00125", "liquid.level=0.02",
               "liquid.viscosity=0.5", "walls.left.inflow=0.02", "model.les=false", "tank.gravity=0"}));
  run.until(2.0);
  ASSERT_FALSE(HasFatalFailure());
  const double depth = 0.02, mean = 0.02, mu = 0.5, h = run.grid.h[1];
  double off = 0.0;
  for (int j = 0; j < 16; ++j) {
    const double y = (j + 0.5) * h;
    off = std::fmax(
        off, std::fabs(run.now.u_c[0][run.cell(64, j)] - 6.0 * mean * y * (depth - y) / (depth * depth)));
  }
  EXPECT_LT(off, 0.01 * mean);
  const double drop = run.now.p_c[run.cell(40, 8)] - run.now.p_c[run.cell(80, 8)];
  EXPECT_NEAR(drop, 12.0 * mu * mean / (depth * depth) * 40 * run.grid.h[0], 0.01 * drop);
}

// Water that comes up through a bed at rest: the pressure falls by the drag of the law in question, beta u /
// f_c^2 per length at the superficial speed u (at low Re the 150 of Ergun), beside the weight of the water.
// A corner of an inlet and a wall: its shear acts on no face whose momentum is solved, and is in neither side
// of the account. Viscosity is explicit in these steps, so that its work is that of what it did.
TEST(Plates, TakeWhatTheInletGives) {
  Simulation run(channel({"walls.top=no-slip", "walls.bottom=no-slip", "grid.dx=0.005",
                          "liquid.viscosity=0.02", "numerics.dt_max=0.005"}));
  Account account(run);
  account.until(0.5);
  const EnergyTerms& energy = run.now.energy;
  const double turnover = energy_turnover(run.scene, account.start, energy);
  EXPECT_GT(energy.viscosity, 0.01 * turnover);
  EXPECT_LT(std::fabs(energy.residual), 1e-6 * turnover);
}

TEST(Bed, TakesThePressureOfErgun) {
  for (const char* law : {"paper", "di-felice", "beetstra"}) {
    Simulation run(
        test::small_tank("ergun", "size = [0.02, 0.08]", 0.08, R"([walls]
all = "slip"
bottom = { inflow = 0.002 }
top = "open"
[bed]
length = 0.02
height = 0.05
solid_fraction = 0.575
[model]
preset = "paper"
)",
                         {std::string("model.drag_law=") + law, "solid.diameter=2e-3", "time.end=10"}));
    Account account(run);
    account.until(2.0);
    ASSERT_FALSE(HasFatalFailure()) << law;
    double drop = 0.0, theory = 0.0;
    const double h = run.grid.h[1], u = 0.002, g = run.scene.gravity;
    for (int j = 2; j < 7; ++j) {
      const std::ptrdiff_t c = run.cell(1, j), below = run.cell(1, j - 1);
      drop += run.now.p_c[below] - run.now.p_c[c] - 1000.0 * g * h;
      const double f = 0.5 * (run.now.f_s[c] + run.now.f_s[below]);
      run.scene.model.drag_law.with([&](auto of) {
        const double slip = u / (1.0 - f);
        const double beta = closures::drag_coefficient(of, f, 1.0, slip, run.scene.gas, run.scene.liquid,
                                                       run.scene.solid.diameter);
        theory += beta * slip / (1.0 - f) * h;
      });
    }
    EXPECT_NEAR(drop, theory, 0.005 * theory) << law;
    EXPECT_GT(drop, 5.0) << law;
    for (int j = 2; j < 7; ++j)
      EXPECT_LT(std::fabs(run.now.u_s[1][run.cell(1, j)]), 1e-5) << law;  // it rests
    EXPECT_LT(account.monitors.solid_volume_error(), 1e-12) << law;
    EXPECT_LT(account.monitors.liquid_volume_error(), 1e-12) << law;
  }
}

// The same through all of the bed and its surface, which lies within a cell, by its faces one after the
// other: what rests there drags no more than its grains do, and hangs in no fluid.
TEST(Bed, TakesThePressureOfErgunAtItsSurfaceToo) {
  for (const char* preset : {"advised", "sourced"}) {
    Simulation run(test::small_tank("ergun", "size = [0.01, 0.08]", 0.08, R"([walls]
all = "slip"
bottom = { inflow = 0.005 }
top = "open"
[bed]
length = 0.01
height = 0.05
solid_fraction = 0.57
)",
                                    {std::string("model.preset=") + preset, "solid.diameter=2e-3"}));
    run.until(1.0);
    ASSERT_FALSE(HasFatalFailure()) << preset;
    const double h = run.grid.h[1], u = 0.005, g = run.scene.gravity;
    double drop = 0.0, theory = 0.0, packed = 0.0;
    int in_part = 0;
    for (int j = 1; j < 14; ++j) {
      const std::ptrdiff_t c = run.cell(1, j), below = run.cell(1, j - 1);
      const double f = 0.5 * (run.now.f_s[c] + run.now.f_s[below]);
      const double of_face = run.now.p_c[below] - run.now.p_c[c] - 1000.0 * g * h;
      double of_law = 0.0;
      run.scene.model.drag_law.with([&](auto of) {
        const double slip = u / (1.0 - f);
        of_law = closures::drag_coefficient(of, f, 1.0, slip, run.scene.gas, run.scene.liquid,
                                            run.scene.solid.diameter) *
                 slip / (1.0 - f) * h;
      });
      // at the surface the flux, and the hindrance of second-order ones, take the packed side's fraction, the
      // law above that of the mean: up to a quarter of what a packed face takes (sourced 1.01 Pa,
      // advised 1.06)
      if (f > 0.57) packed = of_law;
      EXPECT_NEAR(of_face, of_law, f > 0.57 ? 0.03 * of_law : 0.2 * of_law + 0.25 * packed)
          << preset << ", row " << j;
      drop += of_face;
      theory += of_law;
      in_part += run.now.f_s[c] > 0.01 && run.now.f_s[c] < 0.56;
    }
    EXPECT_NEAR(drop, theory, 0.05 * theory) << preset;
    EXPECT_GT(theory, 30.0) << preset;
    EXPECT_EQ(in_part, 1) << preset;
  }
}

// Grains that come in and go out are counted, and carry their energy. (What the solve for the viscosity of
// grains that fly leaves is 2e-8 of it.)
TEST(Grains, ComeInAndLeave) {
  Simulation run(
      channel({"walls.left.inflow_solid_fraction=0.1", "tank.gravity=0", "liquid.level=0.04",
               "tank.size=[0.06, 0.04]", "solid.density=1500", "model.kinetic_transport=collisional"}));
  Account account(run);
  account.until(0.2);
  const double came = 0.1 * 0.1 * 0.04 * 0.2;  // f_s u H t per depth, none of it at the outlet yet
  EXPECT_NEAR(account.solid_left, -came, 1e-3 * came);
  account.until(2.0);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(account.monitors.liquid_volume_error(), 1e-11);
  // As much leaves as comes in: the channel is full of what came.
  EXPECT_NEAR(account.monitors.solid_volume(run.now), 0.1 * 0.06 * 0.04, 0.02 * 0.1 * 0.06 * 0.04);
  EXPECT_LT(account.monitors.solid_volume_error(), 1e-11);
  EXPECT_LT(std::fabs(run.now.energy.residual),
            1e-9 * energy_turnover(run.scene, account.start, run.now.energy));
}

// An inlet that presses grains into a bed works on it: that is given from outside, and no work misstated. (It
// was 0.97 of the energy turned over.)
TEST(Grains, ArePressedIntoABed) {
  for (const char* liquid : {"false", "{level = 0.04, density = 1000, viscosity = 1e-3}"}) {
    Simulation run(test::small_tank("push", "size = [0.08, 0.06]", 0.0, R"([walls]
all = "no-slip"
top = "open"
left = {inflow = 0.02, inflow_solid_fraction = 0.575}
[bed]
length = 0.08
height = 0.04
solid_fraction = 0.575
)",
                                    {std::string("liquid=") + liquid}));
    Account account(run);
    account.until(0.2);
    ASSERT_FALSE(HasFatalFailure());
    const EnergyTerms& end = run.now.energy;
    const double turnover = energy_turnover(run.scene, account.start, end);
    EXPECT_LT(std::fabs(end.residual), 2e-3 * turnover) << liquid;
    EXPECT_GT(account.start.outflow - end.outflow, 0.5 * turnover) << liquid;  // it drives all that happens
  }
}

// A dense bed falls out of a tank of air, or leans on its side: what the grains press and rub on what takes
// them is in the budget (without it a quarter of the energy was not accounted for).
TEST(Grains, LeaveUnderLoad) {
  for (const char* outlet : {"bottom", "right"}) {
    Simulation run(test::small_tank(
        "leave", "size = [0.1, 0.1]", 0.1,
        fmt::format("[walls]\nall = \"no-slip\"\ntop = \"open\"\n{} = {{ outflow_pressure = 0 }}\n[bed]\ny = "
                    "{}\nlength = 0.09\nheight = 0.05\nsolid_fraction = 0.575\n",
                    outlet, outlet[0] == 'b' ? 0.02 : 0.0),
        {"liquid=false", "solid.diameter=1e-3"}));
    Account account(run);
    account.until(0.2);
    ASSERT_FALSE(HasFatalFailure()) << outlet;
    EXPECT_GT(account.solid_left, 0.0) << outlet;
    EXPECT_LT(account.monitors.solid_volume_error(), 1e-12) << outlet;
    EXPECT_LT(std::fabs(run.now.energy.residual),
              1e-4 * energy_turnover(run.scene, account.start, run.now.energy))
        << outlet;
  }
}

}  // namespace
}  // namespace granvof
