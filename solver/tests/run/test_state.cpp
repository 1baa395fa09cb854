// What a bed starts with where the model carries its packing: P_s bears the weight of the grains above.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/run/hydrostatic_pressure.hpp"
#include "solver/run/initial_state.hpp"
#include "solver/state/state.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::box_scene;
using test::Tank;

constexpr int rows = 8;
constexpr double h = 0.01, f_s = 0.6;

// A bed of `count` rows from row `first` on, in a tank full of liquid.
Scene bed(int first, int count, double density) {
  Scene scene = box_scene(2, {4, rows, 1}, {4 * h, rows * h, 1.0});
  scene.solid.density = density;
  scene.model.packing = Packing::of<closures::PackingCarried>();
  scene.liquid_boxes = {Box{{0.0, 0.0, 0.0}, {4 * h, rows * h, 1.0}}};
  scene.bed = Bed{.box = {{0.0, first * h, 0.0}, {4 * h, (first + count) * h, 1.0}}, .solid_fraction = f_s};
  return scene;
}

struct Column {
  explicit Column(const Scene& scene)
      : tank(scene), state(initial_state(tank.grid, tank.scene, tank.boundary)) {}
  double p_s(int j) const { return state.p_s[tank.grid.cells.index(1, j, 0)]; }
  double packing(int j) const { return state.packing[tank.grid.cells.index(1, j, 0)]; }
  Tank tank;
  State state;
};

const double row_weight = f_s * 1500.0 * 9.81 * h;  // of grains of 2500 kg/m3 under water [Pa]

TEST(InitialState, ABedOnTheFloorBearsItsWeight) {
  const Column c(bed(0, 4, 2500.0));
  for (int j = 0; j < 4; ++j) {
    EXPECT_NEAR(c.p_s(j), (3.5 - j) * row_weight, 1e-9 * row_weight) << j;
    EXPECT_NEAR(closures::elastic_pressure(f_s, c.tank.scene.contact, c.packing(j)).value, c.p_s(j),
                1e-4 * row_weight)
        << j;
  }
  EXPECT_EQ(c.p_s(4), 0.0);
  EXPECT_EQ(c.packing(4), c.tank.scene.contact.solid_fraction_min);
}

// The water of a level within the bed's last row is that of its pores: volumes to rounding.
TEST(InitialState, ALevelInTheBedsLastRowFillsItsPores) {
  for (const double level : {3.2, 3.5, 3.8}) {
    Scene scene = bed(0, 3, 2500.0);
    scene.bed->box.upper[1] = 3.5 * h;
    scene.liquid_boxes = {Box{{0.0, 0.0, 0.0}, {4 * h, level * h, 1.0}}};
    const Column c(scene);
    double rows_of_liquid = 0.0;
    for (int j = 0; j < rows; ++j) {
      const std::ptrdiff_t at = c.tank.grid.cells.index(1, j, 0);
      rows_of_liquid += c.state.alpha[at] * (1.0 - c.state.f_s[at]);
    }
    EXPECT_NEAR(rows_of_liquid, level - f_s * std::min(level, 3.5), 1e-12) << level;
  }
}

TEST(InitialState, LightGrainsUnderALidBearTheirBuoyancy) {
  const Column c(bed(4, 4, 400.0));
  for (int j = 4; j < rows; ++j) EXPECT_NEAR(c.p_s(j), (j - 3.5) * 0.4 * row_weight, 1e-9 * row_weight) << j;
  Scene open = bed(4, 4, 400.0);
  open.sides[top].kind = SideKind::open;
  EXPECT_NEAR(Column(open).p_s(7), 0.0, 1e-9 * row_weight);  // nothing to press against
}

// What falls or rises bears nothing, and its contacts store nothing: grains touch where they are.
TEST(InitialState, ABedInFreeFallBearsNothing) {
  for (const double density : {2500.0, 400.0}) {
    const Column c(bed(2, 4, density));
    for (int j = 2; j < 6; ++j) {
      EXPECT_NEAR(c.p_s(j), 0.0, 1e-9 * row_weight) << density << ' ' << j;
      EXPECT_NEAR(c.packing(j), f_s, 1e-6) << density << ' ' << j;
    }
    EXPECT_LT(c.state.energy.elastic, 1e-9 * c.state.energy.potential) << density;
  }
}

// A raft that floats: its dry part presses on the wet one, which bears it by its buoyancy.
TEST(InitialState, ARaftBearsItsDryPart) {
  Scene scene = bed(2, 4, 500.0);
  scene.liquid_boxes[0].upper[1] = 4 * h;
  const Column c(scene);
  const double dry = f_s * 499.0 * 9.81 * h;  // a row of it [Pa]
  EXPECT_NEAR(c.p_s(5), 0.5 * dry, 1e-2 * dry);
  EXPECT_NEAR(c.p_s(4), 1.5 * dry, 1e-2 * dry);
  EXPECT_NEAR(c.p_s(3), 1.5 * dry, 1e-2 * dry);
  EXPECT_NEAR(c.p_s(2), 0.5 * dry, 1e-2 * dry);
}

TEST(InitialState, WithOnePackingForAllNothingIsBorneYet) {
  Scene scene = bed(0, 4, 2500.0);
  scene.model.packing = Packing::of<closures::PackingUniform>();
  const Column c(scene);
  for (int j = 0; j < 4; ++j) {
    EXPECT_EQ(c.p_s(j), 0.0);
    EXPECT_EQ(c.packing(j), scene.contact.solid_fraction_min);
  }
}

// A row that the bed fills in part has the colour of the grains in it.
TEST(InitialState, CellsFilledInPartHaveTheirGrainsColour) {
  Scene scene = bed(0, 2, 2500.0);
  scene.bed->box.upper[1] = 2.5 * h;
  const Column column(scene);
  for (int j = 0; j < rows; ++j)
    EXPECT_EQ(column.state.phi[column.tank.grid.cells.index(1, j, 0)], j < 3 ? 1.0 : 0.0) << j;
}

}  // namespace
}  // namespace granvof
