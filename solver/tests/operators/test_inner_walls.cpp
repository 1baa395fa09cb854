// What is seen across obstacles and the gate: nothing of what is beyond.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "solver/grid/inner_walls.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

constexpr Box floor_of_two_rows{{0.0, 0.0, 0.0}, {0.6, 0.2, 1.0}};

// 6 x 6 cells; obstacles, of two rows on the floor where none are given.
struct Walled {
  explicit Walled(bool obstacle)
      : Walled(obstacle ? std::vector<Box>{floor_of_two_rows} : std::vector<Box>{}) {}
  explicit Walled(std::vector<Box> obstacles) : s(scene(std::move(obstacles))), value(s.grid) {
    s.each(s.grid.cells_and_ghosts(ghost_layers), [&](int i, int j, int, std::ptrdiff_t c) {
      value[c] = 10.0 * (i + 3) + (j + 3);  // no two alike
    });
  }
  static Scene scene(std::vector<Box> obstacles) {
    Scene scene = box_scene(2, {6, 6, 1}, {0.6, 0.6, 1.0});
    scene.obstacles = std::move(obstacles);
    return scene;
  }
  std::ptrdiff_t at(int i, int j) const { return s.grid.cells.index(i, j, 0); }
  double v(int i, int j) const { return value[at(i, j)]; }
  Tank s;
  Field value;
};

TEST(InnerWalls, ThereAreNoneInAnEmptyTank) {
  EXPECT_TRUE(InnerWalls(Walled(false).s.grid).none());
}

TEST(InnerWalls, AScalarGoesOnAsBesideTheWall) {
  const Walled w(true);
  const InnerWalls& walls = w.s.boundary.walls();
  EXPECT_EQ(walls.cells_across(w.value.data(), w.at(2, 3), 1),
            (std::array<double, 4>{w.v(2, 2), w.v(2, 2), w.v(2, 3), w.v(2, 4)}));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 2), {0, -1, 0}), w.v(2, 2));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 2), {1, -1, 0}), w.v(3, 2));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 2), {1, 1, 0}), w.v(3, 3));
}

// Under a wall, and one step from seeing it.
TEST(InnerWalls, AScalarGoesOnAsUnderTheWall) {
  const Walled w({Box{{0.0, 0.4, 0.0}, {0.6, 0.6, 1.0}}});
  const InnerWalls& walls = w.s.boundary.walls();
  EXPECT_EQ(walls.cells_across(w.value.data(), w.at(2, 3), 1),
            (std::array<double, 4>{w.v(2, 1), w.v(2, 2), w.v(2, 3), w.v(2, 3)}));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 3), {0, 1, 0}), w.v(2, 3));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 2), {0, 1, 0}), w.v(2, 3));
}

// Round the corner of a block one sees what is before it and what is upon it, in equal parts.
TEST(InnerWalls, AcrossACornerIsTheMeanOfBothWays) {
  const Walled w({Box{{0.2, 0.0, 0.0}, {0.4, 0.2, 1.0}}});
  const InnerWalls& walls = w.s.boundary.walls();
  EXPECT_DOUBLE_EQ(walls.cell_beside(w.value.data(), w.at(1, 2), {1, -1, 0}), 0.5 * (w.v(2, 2) + w.v(1, 1)));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(2, 3), {0, -1, 0}), w.v(2, 2));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(5, 1), {-1, 0, 0}), w.v(4, 1));
  EXPECT_EQ(walls.cell_beside(w.value.data(), w.at(4, 1), {-1, 0, 0}), w.v(4, 1));
}

TEST(InnerWalls, EveryFaceThatLooksAtAWallIsListedAndEveryEdgeOnIt) {
  const auto of_row = [](const auto& places, int row) {
    return std::ranges::count_if(places, [=](const auto& at) { return at.place[1] == row; });
  };
  const Walled below(true), above({Box{{0.0, 0.4, 0.0}, {0.6, 0.6, 1.0}}});
  EXPECT_EQ(of_row(below.s.boundary.walls().faces(1), 3), 6);
  EXPECT_EQ(of_row(above.s.boundary.walls().faces(1), 3), 6);
  EXPECT_EQ(of_row(below.s.boundary.walls().edges(0), 2), 5);  // those on the tank's sides are the sides'
  for (const InnerWalls::Edge& edge : below.s.boundary.walls().edges(0)) EXPECT_EQ(edge.share, 2.0);
}

TEST(InnerWalls, AVelocityIsTurnedRoundOnAnObstacle) {
  const Walled w(true);
  const InnerWalls& walls = w.s.boundary.walls();
  const double u = w.v(2, 2);
  EXPECT_EQ(walls.faces_along(w.value.data(), w.at(2, 2), 0, 1),
            (InnerWalls::Line{-u, -u, u, w.v(2, 3), w.v(2, 4)}));
  EXPECT_EQ(walls.faces_along(w.value.data(), w.at(2, 3), 0, 1),
            (InnerWalls::Line{-u, u, w.v(2, 3), w.v(2, 4), w.v(2, 5)}));
  // across it: beyond the face on the wall, which keeps its own value
  EXPECT_EQ(walls.faces_along(w.value.data(), w.at(2, 3), 1, 1),
            (InnerWalls::Line{-w.v(2, 3), w.v(2, 2), w.v(2, 3), w.v(2, 4), w.v(2, 5)}));
}

TEST(InnerWalls, AVelocityGoesOnAlongTheGateWhereItStands) {
  Walled w(false);
  w.s.boundary.shut_gate(3, 2);
  const InnerWalls& walls = w.s.boundary.walls();
  EXPECT_EQ(walls.closed_faces(0).size(), 4U);
  const double u = w.v(2, 4);
  EXPECT_EQ(walls.faces_along(w.value.data(), w.at(2, 4), 1, 0),
            (InnerWalls::Line{w.v(0, 4), w.v(1, 4), u, u, u}));
  EXPECT_EQ(walls.faces_along(w.value.data(), w.at(2, 1), 1, 0),
            (InnerWalls::Line{w.v(0, 1), w.v(1, 1), w.v(2, 1), w.v(3, 1), w.v(4, 1)}));  // below its edge
  for (const InnerWalls::Edge& edge : walls.edges(0)) {
    EXPECT_EQ(edge.place[0], 3);
    EXPECT_GT(edge.place[1], 2);  // its lower end is no wall
    EXPECT_EQ(edge.share, 0.0);
  }
  w.s.boundary.shut_gate(3, 6);
  EXPECT_TRUE(walls.closed_faces(0).empty());
  EXPECT_TRUE(walls.faces(1).empty());
}

}  // namespace
}  // namespace granvof
