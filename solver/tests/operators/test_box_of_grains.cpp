// The box the friction solver works on holds every face with grains, and is a function of the state alone.
#include <algorithm>

#include <gtest/gtest.h>

#include "solver/operators/box_of_grains.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof::test {
namespace {

struct Grains {
  explicit Grains(Scene scene) : s(std::move(scene)), inertia(s.grid) {}
  Range box(const Tank::Function& f_s) {
    Field f = s.cells(f_s);
    s.boundary.fill_scalar(f);
    inertia.update(s.grid, s.scene, f, f);
    return box_of_grains(s.grid, inertia);
  }
  Tank s;
  FaceInertia inertia;
};

TEST(BoxOfGrains, EmptyWithoutGrains) {
  Grains g(unit_scene(2, 40));
  EXPECT_TRUE(is_empty(g.box([](const Vec3&) { return 0.0; })));
  EXPECT_TRUE(is_empty(g.box([](const Vec3&) { return 0.4 * least_solid_fraction; })));
}

TEST(BoxOfGrains, HoldsEveryFaceWithGrainsAndARowAround) {
  for (const int dim : {2, 3}) {
    Grains g(unit_scene(dim, 40));
    for (const std::array<int, 3> at : {std::array{0, 0, 0},
                                        {39, 39, dim == 3 ? 39 : 0},
                                        {7, 8, dim == 3 ? 15 : 0},
                                        {16, 23, dim == 3 ? 31 : 0}}) {
      const std::ptrdiff_t cell = g.s.grid.cells.index(at);
      const Range box = g.box([&](const Vec3& x) {
        bool here = true;
        for (int d = 0; d < dim; ++d) here = here && int(x[d] * 40.0) == at[d] && x[d] >= 0.0;
        return here ? 2.0 * least_solid_fraction : 0.0;
      });
      for (int d = 0; d < dim; ++d) {
        const double* f = g.inertia.f_s[d].data();
        EXPECT_GE(f[cell], least_solid_fraction);
        EXPECT_LE(box.lower[d], std::max(at[d] - 1, 0));
        EXPECT_GE(box.upper[d], std::min(at[d] + 2, 40));
        EXPECT_LE(box.upper[d] - box.lower[d], 8);
        EXPECT_TRUE(box.lower[d] % 2 == 0 && box.upper[d] % 2 == 0);
        g.s.each(g.s.grid.inner_faces(d), [&](int i, int j, int k, std::ptrdiff_t c) {
          const std::array<int, 3> face{i, j, k};
          for (int e = 0; e < dim && f[c] >= least_solid_fraction; ++e)
            EXPECT_TRUE(face[e] >= box.lower[e] && face[e] <= box.upper[e]);
        });
      }
    }
  }
}

// Of two levels: what held grains, and what holds them now, each with a cell around.
TEST(BoxOfGrains, HoldsTheGrainsOfTwoLevels) {
  const Tank s(unit_scene(2, 40));
  const auto only = [&](int i, int j) {
    Field f(s.grid);
    f[s.grid.cells.index(i, j, 0)] = 2.0 * least_solid_fraction;
    return f;
  };
  EXPECT_EQ(box_of_grains(s.grid, only(10, 20), only(15, 33)), (Range{{8, 18, 0}, {18, 36, 1}}));
  EXPECT_EQ(box_of_grains(s.grid, only(15, 33), only(10, 20)), (Range{{8, 18, 0}, {18, 36, 1}}));
  EXPECT_EQ(box_of_grains(s.grid, only(0, 0), only(39, 39)), (Range{{0, 0, 0}, {40, 40, 1}}));
  EXPECT_TRUE(is_empty(box_of_grains(s.grid, Field(s.grid), Field(s.grid))));
}

// Every value of a range lies within the part or in one piece outside it.
TEST(BoxOfGrains, PiecesOutsideAPartFillTheRest) {
  const Tank s(unit_scene(3, 8));
  for (const Range& inner :
       {Range{{2, 3, 1}, {5, 8, 7}}, Range{{0, 0, 0}, {8, 8, 8}}, Range{}, Range{{0, 0, 0}, {0, 0, 0}}}) {
    Field seen(s.grid);
    const auto count = [&](const Range& part) {
      for_each_place(part, [&](const std::array<int, 3>& at) { seen[s.grid.cells.index(at)] += 1.0; });
    };
    count(inner);
    for_each_part_outside(s.grid.all_cells(), inner, count);
    for_each_place(s.grid.all_cells(),
                   [&](const std::array<int, 3>& at) { EXPECT_EQ(seen[s.grid.cells.index(at)], 1.0); });
  }
}

TEST(BoxOfGrains, WholeLengthOfAPeriodicDirection) {
  Scene scene = unit_scene(2, 40);
  make_periodic(scene, 0);
  Grains g(scene);
  const Range box = g.box([](const Vec3& x) { return x[1] < 0.1 ? 0.5 : 0.0; });
  EXPECT_EQ(box, (Range{{0, 0, 0}, {40, 6, 1}}));
}

TEST(BoxOfGrains, LayoutsShareTheMemoryOfTheGrid) {
  const Tank s(unit_scene(3, 40));
  const Range box{{8, 16, 0}, {24, 40, 16}};
  const Layout cells = part_of(s.grid.cells, box), faces = faces_of(s.grid, box, 1);
  EXPECT_EQ(cells.n, (std::array{16, 24, 16}));
  EXPECT_EQ(faces.n, (std::array{16, 25, 16}));
  EXPECT_EQ(cells.index(3, 2, 1), s.grid.cells.index(11, 18, 1));
  EXPECT_EQ(faces.index(0, 24, 0), s.grid.cells.index(8, 40, 0));
}

}  // namespace
}  // namespace granvof::test
