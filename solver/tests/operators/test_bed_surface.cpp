// Weight that grains in partly filled cells bear by contact: where it acts, its limits, pressure on the
// walls.
#include <gtest/gtest.h>

#include "solver/operators/bed_surface.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

constexpr int rows = 8;
constexpr double h = 0.01;                               // [m]
constexpr double packed = 0.57;                          // f_s,min
constexpr double half_weight = 0.5 * 1500.0 * 9.81 * h;  // of beads under water [Pa per solid fraction]

// Columns under water, all alike: solid fractions from the floor up, and P_s everywhere.
struct Column {
  Column(const std::array<double, rows>& fractions, double pressure, const Scene& scene = submerged())
      : s(scene), alpha(s.grid, 1.0), p_s(s.grid, pressure), cells(s.grid) {
    f_s = Field(s.grid);
    s.each_cell([&](int, int j, int, std::ptrdiff_t c) { f_s[c] = fractions[static_cast<std::size_t>(j)]; });
    s.boundary.fill_scalar(f_s);
    cells.update(s.grid, s.scene, f_s, alpha, p_s);
  }
  static Scene submerged() { return box_scene(2, {4, rows, 1}, {4 * h, rows * h, 1.0}); }
  static Scene light() {
    Scene scene = submerged();
    scene.solid.density = 400.0;
    return scene;
  }
  double at(int j) const { return cells.resting[s.grid.cells.index(2, j, 0)]; }
  double held(int j) const { return cells.at_rest[s.grid.cells.index(2, j, 0)]; }
  Tank s;
  Field f_s, alpha, p_s;
  PartCells cells;
};

TEST(BedSurface, APartlyFilledCellOnAPackedOneBearsHalfItsWeight) {
  const Column c({packed, 0.574, 0.2, 0, 0, 0, 0, 0}, 100.0);
  EXPECT_NEAR(c.at(2), half_weight * 0.2, 1e-12);
  EXPECT_NEAR(c.at(0), 0.0, 1e-12);                           // covered by a packed cell
  EXPECT_NEAR(c.at(1), half_weight * (packed - 0.2), 1e-12);  // what it holds beyond the cell above
  EXPECT_NEAR(c.held(2), 0.2, 1e-15);
  EXPECT_NEAR(c.held(1), packed - 0.2, 1e-15);
  EXPECT_EQ(c.held(0), 0.0);
}

TEST(BedSurface, TheFloorSupportsThinLayers) {
  const Column c({0.1, 0, 0, 0, 0, 0, 0, 0}, 0.0);
  EXPECT_NEAR(c.at(0), half_weight * 0.1, 1e-12);
}

TEST(BedSurface, DispersedGrainsRestOnNothing) {
  const Column c({packed, 0.03, 0.03, 0.03, 0.03, 0.03, 0.03, 0.03}, 100.0);
  for (int j = 1; j < rows - 1; ++j) EXPECT_EQ(c.at(j), 0.0) << j;
  // nor do those at the upper edge of a cloud, above a cell that bears nothing
  EXPECT_EQ(Column({packed, 0.03, 0.03, 0.02, 0, 0, 0, 0}, 0.0).at(3), 0.0);
}

// Grains fall into a cell below that is looser by a twentieth; one that is denser than that bears them, with
// a short way between the two.
TEST(BedSurface, ALooseCellBelowLetsGrainsIn) {
  const auto borne = [](double below) { return Column({packed, below, 0.2, 0, 0, 0, 0, 0}, 100.0).at(2); };
  EXPECT_NEAR(borne(0.956 * packed), half_weight * 0.2, 1e-12);
  EXPECT_NEAR(borne(0.9525 * packed), 0.5 * half_weight * 0.2, 1e-12);
  EXPECT_EQ(borne(0.949 * packed), 0.0);
}

TEST(BedSurface, ABlockInFreeFallBearsNothing) {
  EXPECT_EQ(Column({0, 0, 0, packed, packed, 0.3, 0, 0}, 0.0).at(5), 0.0);
  EXPECT_NEAR(Column({0, 0, 0, packed, packed, 0.3, 0, 0}, 10.0).at(5), 10.0, 1e-12);
}

TEST(BedSurface, LightGrainsPressUpwardsAlike) {
  const Column heavy({packed, packed, 0.5, 0.3, 0.1, 0, 0, 0}, 100.0);
  const Column light({0, 0, 0, 0.1, 0.3, 0.5, packed, packed}, 100.0, Column::light());
  for (int j = 0; j < rows; ++j) {
    EXPECT_NEAR(light.at(rows - 1 - j), heavy.at(j) * 600.0 / 1500.0, 1e-12) << j;
    EXPECT_NEAR(light.held(rows - 1 - j), -heavy.held(j), 1e-15) << j;
  }
  Scene open = Column::light();
  open.sides[top].kind = SideKind::open;
  EXPECT_EQ(Column({0, 0, 0, 0, 0, 0, 0, 0.3}, 100.0, open).at(rows - 1), 0.0);  // nothing to press against
  EXPECT_GT(Column({0, 0, 0, 0, 0, 0, 0, 0.3}, 100.0, Column::light()).at(rows - 1), 0.0);
}

TEST(BedSurface, GrainsAsHeavyAsTheFluidBearNothing) {
  Scene scene = Column::submerged();
  scene.solid.density = scene.liquid.density;
  const Column c({packed, 0.3, 0, 0, 0, 0, 0, 0}, 100.0, scene);
  for (int j = 0; j < rows; ++j) EXPECT_EQ(c.at(j), 0.0) << j;
}

// A bed that reaches the lid: nothing lies on its uppermost cell, as below a ceiling of obstacles. (The ghosts
// beyond a lid hold what the cell holds, which lay on it.)
TEST(BedSurface, NothingLiesOnTheCellUnderALid) {
  const Column bed({packed, packed, packed, packed, packed, packed, packed, 0.3}, 100.0);
  EXPECT_NEAR(bed.at(rows - 1), half_weight * 0.3, 1e-10);
}

TEST(BedSurface, PressureReachesFloorAndLid) {
  Column c({packed, packed, 0, 0, 0, 0, packed, packed}, 0.0);
  const double weight = half_weight * packed;
  Field weights(c.s.grid);
  set_half_weights(c.s.grid, c.s.scene, c.f_s, c.alpha, weights);
  const auto on_wall = [&](double inside, bool upper) {
    Field p(c.s.grid, inside);
    c.s.boundary.fill_scalar(p);
    extend_to_walls(c.s.grid, weights, p);
    const int j = upper ? rows - 1 : 0;
    return 0.5 * (p[c.s.grid.cells.index(2, j, 0)] + p[c.s.grid.cells.index(2, upper ? rows : -1, 0)]);
  };
  EXPECT_NEAR(on_wall(500.0, false), 500.0 + weight, 1e-10);  // the weight of half a cell more
  EXPECT_NEAR(on_wall(weight, false), 2.0 * weight, 1e-10);   // a single layer: all of its weight
  EXPECT_EQ(on_wall(0.0, false), 0.0);                        // no contact, no friction
  EXPECT_NEAR(on_wall(500.0, true), 500.0, 1e-10);            // heavy grains do not press on a lid
}

}  // namespace
}  // namespace granvof
