// Continuity closed to rounding: in every kind of tank, through open faces only, and by little.
#include <gtest/gtest.h>

#include "solver/operators/continuity_closure.hpp"
#include "solver/operators/continuity_tree.hpp"
#include "solver/tests/operators/tank.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using test::Tank;

Scene closed(int dim) {
  return test::box_scene(dim, {8, 6, dim == 3 ? 4 : 1}, {0.8, 0.9, 0.8});
}
Scene joined(int dim, std::vector<int> directions) {
  Scene scene = closed(dim);
  for (const int d : directions) test::make_periodic(scene, d);
  return scene;
}
Scene open_top(int dim) {
  Scene scene = closed(dim);
  scene.sides[top].kind = SideKind::open;
  return scene;
}
Scene gated(Scene scene) {
  scene.gate = Gate{0.3, 1.0};
  return scene;
}

// Random fluxes of both phases, the gate closed to them; then the flux that closes continuity.
struct Closed {
  Closed(Scene given, double time, bool by_tree = false, const Communicator* processes = nullptr)
      : s(std::move(given), processes), aperture(s.grid, s.scene) {
    aperture.update(time);
    flux_s = s.random_faces(-1e-3, 1e-3);
    before = s.random_faces(-1e-3, 1e-3);
    for (int d = 0; d < s.grid.dim; ++d)
      if (s.grid.side(d, false).passes_fluid || s.grid.side(d, true).passes_fluid)
        s.each(s.grid.fluid_faces(d),
               [&](int, int, int, std::ptrdiff_t c) { before[d][c] = s.uniform(-1e-3, 1e-3); });
    for (int d = 0; d < s.grid.dim; ++d)
      s.each(s.grid.fluid_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        before[d][c] *= aperture[d][c];
        flux_s[d][c] *= aperture[d][c];
      });
    for (int d = 0; d < s.grid.dim; ++d) {
      s.boundary.exchange(before[d]);
      s.boundary.exchange(flux_s[d]);
    }
    after = before;
    if (!by_tree) {
      close_continuity(s.grid, s.boundary, aperture, flux_s, after);
      return;
    }
    ContinuityTree tree(s.grid);
    tree.grow(aperture);
    tree.close(s.boundary, flux_s, after);
  }
  double residual(const FaceField& flux_c) const {
    double largest = 0.0;
    s.each_cell([&](int, int, int, std::ptrdiff_t c) {
      largest = std::fmax(largest, std::fabs(s.divergence(flux_s, c) + s.divergence(flux_c, c)));
    });
    return largest;
  }
  Tank s;
  Aperture aperture;
  FaceField flux_s, before, after;
};

TEST(ContinuityClosure, ClosesEveryTankThroughOpenFacesOnly) {
  for (const int dim : {2, 3}) {
    std::vector<Scene> scenes{
        closed(dim),        open_top(dim),        joined(dim, {0}),       joined(dim, {0, 1}),
        gated(closed(dim)), gated(open_top(dim)), gated(joined(dim, {0}))};
    if (dim == 3) {
      scenes.push_back(joined(3, {2}));
      scenes.push_back(joined(3, {0, 2}));
      scenes.push_back(gated(joined(3, {2})));
    }
    for (std::size_t i = 0; i < scenes.size(); ++i)
      for (const double time : {-1.0, 0.4, 2.0}) {  // the gate down, in part up, gone
        SCOPED_TRACE(testing::Message() << dim << "D, tank " << i << ", t = " << time);
        const Closed c(scenes[i], time);
        EXPECT_GT(c.residual(c.before), 1e-3);
        EXPECT_LT(c.residual(c.after), 1e-15);
        for (int d = 0; d < dim; ++d)
          c.s.each(c.s.grid.all_faces(d), [&](int, int, int, std::ptrdiff_t at) {
            if (c.aperture[d][at] == 0.0) {
              EXPECT_EQ(c.after[d][at], 0.0);
            }
          });
      }
  }
}

TEST(ContinuityClosure, LeavesClosedFluxesAlone) {
  Tank s(closed(2));
  const Aperture aperture(s.grid, s.scene);
  FaceField none(s.grid), flux(s.grid);
  s.each(s.grid.inner_faces(0), [&](int i, int j, int, std::ptrdiff_t c) {
    flux[0][c] = i == 4 && (j == 1 || j == 2) ? (j == 1 ? 1.0 : -1.0) : 0.0;
  });
  // a ring of unit fluxes over four cells: 0.1 wide, 0.15 high
  flux[1][s.grid.cells.index(3, 2, 0)] = -1.5;
  flux[1][s.grid.cells.index(4, 2, 0)] = 1.5;
  FaceField after = flux;
  close_continuity(s.grid, s.boundary, aperture, none, after);
  for (int d : {0, 1})
    s.each(s.grid.all_faces(d),
           [&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(after[d][c], flux[d][c], 1e-14); });
}

// A source below and a sink above the middle: what closes them flows straight up between them.
TEST(ContinuityClosure, GoesTheShortWayUpAndOutOfAnOpenTop) {
  Tank s(open_top(2));
  const Aperture aperture(s.grid, s.scene);
  FaceField none(s.grid), flux(s.grid);
  flux[1][s.grid.cells.index(2, 3, 0)] = -0.3;  // cell (2, 2) gains, cell (2, 3) loses
  close_continuity(s.grid, s.boundary, aperture, none, flux);
  for (int d : {0, 1})
    s.each(s.grid.all_faces(d),
           [&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(flux[d][c], 0.0, 1e-15); });
  flux[0][s.grid.cells.index(2, 3, 0)] = 0.1;  // from cell (1, 3) to cell (2, 3)
  close_continuity(s.grid, s.boundary, aperture, none, flux);
  EXPECT_NEAR(flux[1][s.grid.cells.index(2, 6, 0)], 0.15, 1e-15);
  EXPECT_NEAR(flux[1][s.grid.cells.index(1, 6, 0)], -0.15, 1e-15);
  EXPECT_EQ(flux[1][s.grid.cells.index(2, 3, 0)], 0.0);
}

// The same by the tree, where columns are cut by obstacles and fluid leaves through sides.
TEST(ContinuityTree, ClosesEveryTankThroughOpenFacesOnly) {
  const auto with_box = [](Scene scene) {
    scene.obstacles = {{{0.2, 0.15, 0.0}, {0.5, 0.6, scene.dimensions == 3 ? 0.4 : 0.8}}};
    return scene;
  };
  const auto with_outlet = [](Scene scene, int side) {
    scene.sides[side].kind = SideKind::outlet;
    return scene;
  };
  for (const int dim : {2, 3}) {
    const std::vector<Scene> scenes{with_box(closed(dim)),
                                    with_box(open_top(dim)),
                                    with_box(joined(dim, {0})),
                                    with_box(joined(dim, {0, 1})),
                                    with_outlet(closed(dim), right),
                                    with_outlet(with_box(closed(dim)), left),
                                    with_outlet(with_outlet(closed(dim), left), bottom),
                                    gated(with_outlet(closed(dim), right))};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      SCOPED_TRACE(testing::Message() << dim << "D, tank " << i);
      const Closed c(scenes[i], -1.0, true);
      EXPECT_FALSE(c.s.grid.has_whole_columns());
      EXPECT_GT(c.residual(c.before), 1e-3);
      EXPECT_LT(c.residual(c.after), 1e-14);
      for (int d = 0; d < dim; ++d)
        c.s.each(c.s.grid.all_faces(d), [&](int, int, int, std::ptrdiff_t at) {
          if (c.aperture[d][at] == 0.0) {
            EXPECT_EQ(c.after[d][at], 0.0);
          }
        });
    }
  }
}

// Processes that share a tank each close their slab: with one part or several, that drain or do not, along
// and across the cuts.
TEST(ContinuityTree, ClosesTheSlabsOfSeveralProcesses) {
  using Boxes = std::vector<Box>;
  const auto wide = [](const Boxes& obstacles) {
    Scene scene = test::box_scene(2, {16, 6, 1}, {1.6, 0.9, 0.8});
    scene.obstacles = obstacles;
    return scene;
  };
  const Box plate{{0.3, 0.45, 0.0}, {1.3, 0.6, 0.8}};  // parts the slabs in the middle in two
  const Box wall{{0.5, 0.0, 0.0}, {0.6, 0.9, 0.8}};    // parts the tank
  const Box step{{0.7, 0.0, 0.0}, {0.9, 0.3, 0.8}}, one{{1.5, 0.15, 0.0}, {1.6, 0.3, 0.8}};
  const auto with_outlet = [](Scene scene, int side) {
    scene.sides[side].kind = SideKind::outlet;
    return scene;
  };
  const auto in_a_ring = [](Scene scene) {
    test::make_periodic(scene, 0);
    return scene;
  };
  const std::vector<Scene> scenes{wide({plate}),
                                  wide({wall, step}),
                                  in_a_ring(wide({plate, one})),
                                  in_a_ring(wide({wall})),
                                  with_outlet(wide({}), right),
                                  with_outlet(wide({plate, step}), left),
                                  with_outlet(wide({wall}), right),
                                  with_outlet(wide({plate}), bottom),
                                  gated(with_outlet(wide({plate}), right))};
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (const int processes : {2, 3, 4}) {
      SCOPED_TRACE(testing::Message() << "tank " << i << ", " << processes << " processes");
      test::Team team(processes, test::Boxes::slabs);
      ASSERT_NO_THROW(team.run([&](int rank, const Communicator& communicator) {
        for (const double time : {-1.0, 0.4}) {
          const Closed c(scenes[i], time, true, &communicator);
          EXPECT_GT(c.residual(c.before), 1e-3) << rank;
          EXPECT_LT(c.residual(c.after), 1e-14) << rank;
          for (const int d : {0, 1})
            c.s.each(c.s.grid.all_faces(d), [&](int, int, int, std::ptrdiff_t at) {
              if (c.aperture[d][at] == 0.0) {
                EXPECT_EQ(c.after[d][at], 0.0);
              }
            });
        }
      }));
    }
}

TEST(ContinuityClosure, APeriodicTankHasNoFirstColumn) {
  Tank s(joined(2, {0}));
  const Aperture aperture(s.grid, s.scene);
  const FaceField none(s.grid), given = s.random_faces(-1e-3, 1e-3);
  const int n = s.grid.cells.n[0], by = 3;
  FaceField shifted(s.grid);
  const auto move = [&](const FaceField& from, FaceField& to) {
    for (int d : {0, 1}) {
      s.each(s.grid.inner_faces(d), [&](int i, int j, int, std::ptrdiff_t c) {
        to[d][s.grid.cells.index((i + by) % n, j, 0)] = from[d][c];
      });
      s.boundary.exchange(to[d]);
    }
  };
  move(given, shifted);
  FaceField a = given, b = shifted, moved(s.grid);
  close_continuity(s.grid, s.boundary, aperture, none, a);
  close_continuity(s.grid, s.boundary, aperture, none, b);
  move(a, moved);
  for (int d : {0, 1})
    s.each(s.grid.inner_faces(d),
           [&](int, int, int, std::ptrdiff_t c) { EXPECT_NEAR(b[d][c], moved[d][c], 1e-16); });
}

}  // namespace
}  // namespace granvof
