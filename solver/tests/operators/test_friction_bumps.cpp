// Grains that collide with the bumps of a wall: stress, slip and heat of closures/bumpy_wall.hpp.
#include <numbers>

#include "solver/closures/bumpy_wall.hpp"
#include "solver/tests/operators/friction_bed.hpp"

namespace granvof {
namespace {

using test::Layer;

constexpr double viscosity = 50.0, bump_pressure = 20.0, force = 300.0;  // [Pa s], [Pa s/m], [Pa/m]

Layer on_bumps(double degrees) {
  Scene scene = Layer::between(WallKind::bumpy, WallKind::slip);
  scene.sides[bottom].solid.bumpiness = degrees;
  return Layer(scene);
}

// What the wall bears is what the force gives less what the mass takes; over the half cell beside it the
// kinetic viscosity takes the same, and what is left of the speed is the slip.
TEST(FrictionOnBumps, SlipIsThatOfTheStress) {
  for (const double degrees : {20.0, 36.0, 90.0}) {
    Layer layer = on_bumps(degrees);
    layer.rheology.kinetic_viscosity.fill(viscosity);
    layer.rheology.bump_pressure = Field(layer.s.grid, bump_pressure);
    layer.set(500.0, force);
    layer.solve();
    const double h = layer.s.grid.h[1];
    double stress = 0.0;
    for (int j = 0; j < 16; ++j)
      stress += h * (force - 500.0 * layer.u[0][layer.s.grid.cells.index(1, j, 0)]);
    const double slip = layer.u[0][layer.s.grid.cells.index(1, 0, 0)] - 0.5 * h * stress / viscosity;
    const double k = closures::bumpy_wall_slip(degrees * std::numbers::pi / 180.0);
    EXPECT_NEAR(slip, k * stress / bump_pressure, 1e-6 * slip) << degrees;
    EXPECT_GT(slip, 0.0);
  }
}

// All that the force does, less what the mass takes, heats the grains: the slip's work with the rest.
TEST(FrictionOnBumps, WorkOfTheSlipHeatsTheGrains) {
  Layer layer = on_bumps(36.0);
  layer.rheology.kinetic_viscosity.fill(viscosity);
  layer.rheology.bump_pressure = Field(layer.s.grid, bump_pressure);
  layer.set(500.0, force);
  layer.solve();
  Field heat(layer.s.grid);
  const Friction::Power power = layer.power(layer.u, layer.u, heat);
  double work = 0.0;
  for (int j = 0; j < 16; ++j) {
    const double u = layer.u[0][layer.s.grid.cells.index(1, j, 0)];
    work += 4.0 * layer.s.grid.cell_volume * u * (force - 500.0 * u);
  }
  EXPECT_NEAR(power.kinetic, work, 1e-6 * work);
  EXPECT_NEAR(power.friction, 0.0, 1e-6 * work);
}

}  // namespace
}  // namespace granvof
