// What must not depend on the direction, the dimension or a coordinate that a scene does not have.
#include <cmath>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::column_scene;
using test::Simulation;

double largest(const Field& f) {
  double most = 0.0;
  for (double v : f.span()) most = std::fmax(most, std::fabs(v));
  return most;
}

// A column that collapses from the right wall is the mirror image of one from the left, to what the solvers
// leave: preconditioners round to single precision, and the friction solve stops at 1e-7 m/s. Measured in
// f_s: see below.
TEST(Symmetry, MirroredColumn) {
  const auto scene = [](bool mirrored) {
    Scene s =
        column_scene({"grid.dx=0.005", "numerics.volume_tolerance=1e-10", "numerics.linear_tolerance=1e-6"});
    s.gate.reset();
    if (mirrored) s.bed->box = {{0.11, 0.0, 0.0}, {0.16, 0.04, s.bed->box.upper[2]}};
    return s;
  };
  Simulation a(scene(false)), b(scene(true));
  const int n = a.grid.cells.n[0];
  struct Bound {
    double time, f_s, u;
  };
  for (const Bound& bound : {Bound{0.001, 1e-9, 1e-7}, Bound{0.01, 1e-7, 1e-6}, Bound{0.05, 1e-5, 1e-5}}) {
    a.until(bound.time);
    b.until(bound.time);
    EXPECT_EQ(a.steps, b.steps);
    double f_s = 0.0, u = 0.0;
    for (int j = 0; j < a.grid.cells.n[1]; ++j)
      for (int i = 0; i < n; ++i) {
        const std::ptrdiff_t c = a.grid.cells.index(i, j, 0), m = a.grid.cells.index(n - 1 - i, j, 0);
        f_s = std::fmax(f_s, std::fabs(a.now.f_s[c] - b.now.f_s[m]));
        u = std::fmax(u, std::fabs(a.now.u_s[0][c + 1] + b.now.u_s[0][m]));
        u = std::fmax(u, std::fabs(a.now.u_c[1][c] - b.now.u_c[1][m]));
      }
    EXPECT_LT(f_s, bound.f_s) << bound.time;
    EXPECT_LT(u, bound.u) << bound.time;
  }
  EXPECT_GT(a.fastest(a.now.u_s), 0.01);
}

// One cell between slip walls in z is the 2D scene (LES off: its length scale knows the dimension).
TEST(Symmetry, OneCellDeepIsTwoDimensional) {
  const auto scene = [](bool three) {
    Scene s = column_scene({"model.les=false", "time.end=0.05"});
    s.gate.reset();
    if (three) {
      s.dimensions = 3;
      s.tank[2] = s.grid.spacing[2] = 0.01;
      s.bed->box.upper[2] = 0.01;
      for (Box& box : s.liquid_boxes) box.upper[2] = 0.01;
      for (int side : {front, back}) s.sides[side].fluid.kind = s.sides[side].solid.kind = WallKind::slip;
    }
    return s;
  };
  Simulation flat(scene(false)), deep(scene(true));
  flat.until(0.05);
  deep.until(0.05);
  EXPECT_EQ(flat.steps, deep.steps);
  EXPECT_EQ(largest(deep.now.u_s[2]), 0.0);
  EXPECT_EQ(largest(deep.now.u_c[2]), 0.0);
  double f_s = 0.0, alpha = 0.0, u = 0.0;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 16; ++i) {
      const std::ptrdiff_t a = flat.grid.cells.index(i, j, 0), b = deep.grid.cells.index(i, j, 0);
      f_s = std::fmax(f_s, std::fabs(flat.now.f_s[a] - deep.now.f_s[b]));
      alpha = std::fmax(alpha, std::fabs(flat.now.alpha[a] - deep.now.alpha[b]));
      for (int d : {0, 1}) u = std::fmax(u, std::fabs(flat.now.u_s[d][a] - deep.now.u_s[d][b]));
    }
  EXPECT_GT(flat.fastest(flat.now.u_s), 0.01);
  EXPECT_LT(f_s, 1e-6);
  EXPECT_LT(alpha, 1e-6);
  EXPECT_LT(u, 1e-5);
}

// Slip side walls and a bed as wide as the tank: nothing may come to depend on x.
struct Spread {
  double f_s = 0.0, alpha = 0.0, u = 0.0,
         across = 0.0;  // largest difference along x; largest velocity along x
};

Spread spread_along_x(const Simulation& run) {
  Spread s;
  for (int j = 0; j < run.grid.cells.n[1]; ++j)
    for (int i = 0; i < run.grid.cells.n[0]; ++i) {
      const std::ptrdiff_t c = run.grid.cells.index(i, j, 0), first = run.grid.cells.index(0, j, 0);
      s.f_s = std::fmax(s.f_s, std::fabs(run.now.f_s[c] - run.now.f_s[first]));
      s.alpha = std::fmax(s.alpha, std::fabs(run.now.alpha[c] - run.now.alpha[first]));
      s.u = std::fmax(s.u, std::fabs(run.now.u_s[1][c] - run.now.u_s[1][first]));
      s.across = std::fmax(s.across, std::fmax(std::fabs(run.now.u_s[0][c]), std::fabs(run.now.u_c[0][c])));
    }
  return s;
}

Scene piston(std::vector<std::string> overrides) {
  return load_scene(cases_directory() / "float-full-r02.toml", overrides);
}

// Before the water stops the bed nothing amplifies what rounding leaves. Measured: 1.1e-9.
TEST(Symmetry, NothingDependsOnXInAFallingPiston) {
  Simulation run(piston({"grid.dy=0.01", "model.granular_temperature=off", "numerics.volume_tolerance=1e-12",
                         "numerics.linear_tolerance=1e-8"}));
  run.until(0.015);
  EXPECT_GT(run.fastest(run.now.u_s), 0.1);
  const Spread s = spread_along_x(run);
  EXPECT_LT(s.f_s, 1e-8);
  EXPECT_LT(s.alpha, 1e-8);
  EXPECT_LT(s.u, 1e-8);
  EXPECT_LT(s.across, 1e-8);
}

// Known problem: while the bed's lower edge is compacted on the water, differences of 1e-8 (the
// single-precision preconditioners' and the friction solve's) grow a thousandfold in a few steps; tighter
// tolerances do not change that. They then stay: up to 1.7e-4 in f_s and 2e-4 m/s were measured up to t =
// 0.33. The bound is on their staying small.
TEST(Symmetry, APistonStaysAPiston) {
  Simulation run(piston({}));
  for (double time : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3}) {
    run.until(time);
    const Spread s = spread_along_x(run);
    EXPECT_LT(s.f_s, 1e-3) << time;
    EXPECT_LT(s.alpha, 1e-3) << time;
    EXPECT_LT(s.across, 1e-3) << time;
  }
}

TEST(Rest, APoolStaysAtRest) {
  Scene scene = load_scene(cases_directory() / "pool.toml", std::vector<std::string>{"grid.dx=0.01"});
  Simulation run(scene);
  double fastest = 0.0;
  while (run.now.time < 0.5) {
    run.advance();
    fastest = std::fmax(fastest, run.fastest(run.now.u_c));
  }
  RecordProperty("fastest", std::to_string(fastest));
  EXPECT_LT(fastest, 1e-5);
  EXPECT_GT(run.steps, 50);
}

}  // namespace
}  // namespace granvof
