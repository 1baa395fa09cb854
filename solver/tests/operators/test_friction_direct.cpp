// Thin beds in two dimensions, whose friction system is factorised: how many iterations are left, and that
// the answer is that of the iteration. (That both solve the right problem: test_friction.cpp.)
#include <cmath>

#include <gtest/gtest.h>

#include "solver/tests/operators/friction_bed.hpp"

namespace granvof {
namespace {

using test::Bed;
using test::box_scene;

// A raft in the middle of a tank, or on its floor and left side, of viscosity that jumps from cell to cell as
// that of a bed at rest does; pushed unevenly, so that it bends.
struct Raft : Bed {
  Raft(std::array<int, 2> cells, int lower, int upper, WallKind kind)
      : Bed(box_scene(2, {cells[0], cells[1], 1}, {0.01 * cells[0], 0.01 * cells[1], 1.0}, kind)) {
    f_s.fill(0.0);
    s.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
      if (j < lower || j >= upper || i >= cells[0] - 4) return;
      f_s[c] = 0.5;
      rheology.enduring_pressure[c] = 10.0 * (1 + (7 * i + 3 * j) % 5);
      rheology.kinetic_viscosity[c] = 0.1 * (1 + (i + j) % 3);
    });
    for (int d = 0; d < 2; ++d) {
      mass[d].fill(1250.0 / test::step);
      s.each(s.grid.inner_faces(d), [&](int i, int j, int, std::ptrdiff_t c) {
        rhs[d][c] = 1e4 * std::sin(0.3 * i + d) + 1e3 * std::cos(0.9 * j);
      });
    }
    fill();
  }
  linear::Report solve_once() { return friction.solve(balance, inertia, aperture, rheology, now, next); }
};

TEST(FrictionDirect, ThinRaftTakesTwoIterationsAtMost) {
  for (const WallKind kind : {WallKind::slip, WallKind::no_slip}) {
    Raft floating({96, 16}, 6, 10, kind), resting({96, 16}, 0, 5, kind);
    for (Raft* raft : {&floating, &resting}) {
      const linear::Report report = raft->solve_once();
      EXPECT_TRUE(report.converged);
      EXPECT_GT(report.iterations, 0);
      EXPECT_LE(report.iterations, 2);
    }
  }
}

TEST(FrictionDirect, FactorisesThinBedsOnly) {
  const auto factorises = [](int thick) {
    Raft raft({96, 64}, 0, thick, WallKind::no_slip);
    const Grid& grid = raft.s.grid;
    FaceField marked(grid);
    for (int d = 0; d < 2; ++d)
      raft.s.each(grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        marked[d][c] = raft.inertia.f_s[d][c] >= least_solid_fraction ? 1.0 : 0.0;
      });
    const Field viscosity(grid, 1.0);
    FrictionDirect direct(grid);
    return direct.factorise(box_of_grains(grid, raft.inertia), {{viscosity.data(), viscosity.data()},
                                                                viscosity.data(),
                                                                viscosity.data(),
                                                                nullptr,
                                                                {marked[0].data(), marked[1].data()},
                                                                {raft.mass[0].data(), raft.mass[1].data()}});
  };
  EXPECT_TRUE(factorises(5));
  EXPECT_TRUE(factorises(18));
  EXPECT_FALSE(factorises(40));
}

}  // namespace
}  // namespace granvof
