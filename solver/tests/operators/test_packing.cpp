// The packing field under shear.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/operators/packing.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::Tank;
using test::unit_scene;

constexpr double dt = 0.01, rate = 20.0;  // [s], [1/s]

// Packing of a middle cell after dt of u = (x, y) -> (a x + b y, c y), f_s and packing uniform.
double after(double f_s, double packing, double a, double b, double c, const Scene& scene = unit_scene(2, 6),
             double pressure = 0.0) {
  const Tank s(scene);
  StrainRate strain(s.grid);
  strain.update(s.grid, s.boundary.walls(),
                s.faces({[=](const Vec3& x) { return a * x[0] + b * x[1]; },
                         [=](const Vec3& x) { return c * x[1]; }, [](const Vec3&) { return 0.0; }}));
  const Field f(s.grid, f_s);
  Field p(s.grid, packing);
  Rheology rheology(s.grid);
  rheology.enduring_pressure = Field(s.grid, pressure);
  rheology.pore_viscosity = Field(s.grid, s.scene.liquid.viscosity);
  shear_packing(s.grid, s.scene, dt, f, rheology, strain, p);
  return p[s.grid.cells.index(3, 3, 0)];
}

TEST(Packing, SimpleShearFollowsTheLaw) {
  for (const double packing : {0.575, 0.61})
    EXPECT_NEAR(after(0.6, packing, 0.0, rate, 0.0), closures::sheared_packing(packing, rate * dt, Contact{}),
                1e-12);
}

TEST(Packing, PureShearIsShear) {
  EXPECT_NEAR(after(0.6, 0.61, 0.5 * rate, 0.0, -0.5 * rate),
              closures::sheared_packing(0.61, rate * dt, Contact{}), 1e-12);
}

// Of a uniform stretch k along x and y the deviator's square is 2 k^2 - (2 k)^2 / 3.
TEST(Packing, StretchShearsByItsDeviator) {
  EXPECT_NEAR(after(0.6, 0.61, rate, 0.0, rate),
              closures::sheared_packing(0.61, rate * dt * std::sqrt(4.0 / 3.0), Contact{}), 1e-12);
}

TEST(Packing, RestLeavesItAlone) {
  EXPECT_DOUBLE_EQ(after(0.6, 0.61, 0.0, 0.0, 0.0), 0.61);
}

// Fast shear in a viscous liquid drives a bed to a looser packing, and a load holds it against that.
TEST(Packing, ByRateFollowsTheLoadAndTheLiquid) {
  Scene scene = unit_scene(2, 6);
  scene.model.critical_packing = CriticalPacking::of<closures::CriticalPackingByRate>();
  scene.liquid.viscosity = 0.1;
  scene.solid.density = 2500.0;
  scene.solid.diameter = 1e-4;
  for (const double pressure : {1e3, 1e5}) {
    const double critical = closures::CriticalPackingByRate::packing(
        closures::mixed_inertial_number(rate, pressure, 2500.0, 1e-4, 0.1), Contact{});
    EXPECT_LT(critical, Contact{}.critical_solid_fraction);
    EXPECT_NEAR(after(0.6, 0.6, 0.0, rate, 0.0, scene, pressure),
                closures::sheared_packing(0.6, rate * dt, critical, Contact{}), 1e-12);
  }
}

TEST(Packing, DispersedGrainsForget) {
  EXPECT_EQ(after(0.5, 0.61, 0.0, rate, 0.0), Contact{}.solid_fraction_min);
  EXPECT_EQ(after(0.0, 0.61, 0.0, 0.0, 0.0), Contact{}.solid_fraction_min);
}

}  // namespace
}  // namespace granvof
