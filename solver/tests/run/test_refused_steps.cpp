// Steps that are refused: what a cell holds bounds what may leave it, and packing what may come.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/run/initial_state.hpp"
#include "solver/run/time_step.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof {
namespace {

// Light grains that hardly press on each other, in as light a fluid, without gravity or drag: what moves goes
// on.
Scene drift(double solid_fraction_max) {
  return parse_scene(fmt::format(R"([scene]
name = "drift"
[tank]
size = [0.04, 0.02]
gravity = 0
[grid]
dx = 0.01
[walls]
left = "periodic"
right = "periodic"
all = "slip"
[gas]
density = 1
viscosity = 0
[solid]
density = 1
diameter = 1e-3
friction = 0
[contact]
stiffness = 1e-6
solid_fraction_max = {}
dense_solid_fraction = 0.62
[bed]
length = 0.04
height = 0.02
solid_fraction = 0.5
[model]
preset = "paper"
drag = false
[time]
end = 1
)",
                                 solid_fraction_max),
                     "drift");
}

// Why a step of 1 ms is refused where grains of `f_s` in the second column drift at `behind` and `ahead`
// [m/s] on its two faces, those elsewhere at `ahead`, and the fluid so that nothing flows on balance but a
// `stream` of both.
std::string refused(double f_s, double behind, double ahead, double stream,
                    double solid_fraction_max = 0.63) {
  const Scene scene = drift(solid_fraction_max);
  const Grid grid(scene);
  Boundary boundary(grid);
  State now = initial_state(grid, scene, boundary), next(grid);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 4; ++i) {
      const std::ptrdiff_t c = grid.cells.index(i, j, 0);
      now.u_s[0][c] = stream + (i == 1 ? behind : ahead);
      now.u_c[0][c] = stream;
    }
    now.f_s[grid.cells.index(1, j, 0)] = f_s;
  }
  now.fill_ghosts(boundary);
  TimeStep step(grid, scene, boundary);
  return step.advance(now, 1e-3, next).refused_because;
}

// In a stream of both phases at 12 m/s, 1.2 cells a step, a cell would lose more than it holds; at 8 m/s it
// does not.
TEST(RefusedStep, MoreThanACellHoldsWouldLeaveIt) {
  EXPECT_EQ(refused(0.5, 0.0, 0.0, 12.0), "outflow Courant number 1.20 of the solid");
  EXPECT_EQ(refused(0.5, 0.0, 0.0, 8.0), "");
}

// Grains that run into those ahead of them: 0.65, the densest that the contacts know, and a tenth of it in a
// step.
TEST(RefusedStep, DenserThanGrainsCanBe) {
  EXPECT_EQ(refused(0.65, 1.0, 0.0, 0.0).substr(0, 14), "solid fraction");
  EXPECT_EQ(refused(0.65, 1.0, 0.0, 0.0, 0.74), "");
  EXPECT_EQ(refused(0.5, 0.1, 0.0, 0.0), "");
}

}  // namespace
}  // namespace granvof
