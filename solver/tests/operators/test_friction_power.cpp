// What the solid stress spends, cell by cell and in all.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/closures/contact_friction.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/tests/operators/friction_bed.hpp"

namespace granvof {
namespace {

using test::Bed;
using test::box_scene;
using test::make_periodic;

// What the granular temperature is given: per cell, mu^K G^2 under a shear G, and nothing where the stress
// was cut, beside a face without grains.
TEST(Friction, KineticPowerOfEachCell) {
  Scene scene = box_scene(2, {4, 6, 1}, {0.4, 0.6, 1.0});
  make_periodic(scene, 0);
  scene.model.contact_friction = false;
  const double rate = 3.0, mu = 0.2;
  for (const bool empty_top : {false, true}) {
    Bed bed(scene);
    bed.rheology.kinetic_viscosity.fill(mu);
    if (empty_top)
      bed.s.each_cell([&](int, int j, int, std::ptrdiff_t c) {
        if (j >= 4) bed.f_s[c] = bed.rheology.kinetic_viscosity[c] = 0.0;
      });
    bed.u = bed.s.faces({[=](const Vec3& x) { return x[1] < 0.4 ? rate * x[1] : 10.0; },
                         [](const Vec3&) { return 0.0; }, [](const Vec3&) { return 0.0; }});
    bed.u_strain = bed.u;
    bed.fill();
    for (int d = 0; d < 2; ++d)
      bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) { bed.mass[d][c] = 1e9; });
    bed.rhs = bed.u;
    for (int d = 0; d < 2; ++d)
      bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) { bed.rhs[d][c] *= 1e9; });
    bed.solve();  // so heavy that nothing moves
    Field kinetic(bed.s.grid);
    const Friction::Power power = bed.power(bed.u, bed.u, kinetic);
    EXPECT_NEAR(power.kinetic, bed.s.total(kinetic) * bed.s.grid.cell_volume, 1e-12 * power.kinetic);
    const auto at = [&](int j) { return kinetic[bed.s.grid.cells.index(1, j, 0)]; };
    EXPECT_NEAR(at(1), mu * rate * rate, 1e-6 * mu * rate * rate);
    EXPECT_NEAR(at(2), mu * rate * rate, 1e-6 * mu * rate * rate);
    if (empty_top) {
      EXPECT_NEAR(at(3), 0.5 * mu * rate * rate, 1e-6 * mu * rate * rate);  // its upper edges are cut
      EXPECT_EQ(at(4), 0.0);
    }
  }
}

// A bed sheared at `rate` that expands upwards, so heavy that nothing moves.
struct ShearedBed : Bed {
  ShearedBed(const Scene& scene, double contacts, double collisions, double viscosity) : Bed(scene) {
    rheology.kinetic_viscosity.fill(viscosity);
    rheology.kinetic_pressure = Field(s.grid, collisions);
    rheology.enduring_pressure.fill(contacts);
  }
  Friction::Power spends(double rate, double expansion, Field& by_collisions) {
    u = u_strain =
        s.faces({[=](const Vec3& x) { return rate * x[1]; }, [=](const Vec3& x) { return expansion * x[1]; },
                 [](const Vec3&) { return 0.0; }});
    rhs = u;
    for (int d = 0; d < 2; ++d) {
      mass[d].fill(1e9);
      s.each_cell([&](int, int, int, std::ptrdiff_t c) { rhs[d][c] *= 1e9; });
    }
    solve();
    return power(u, u, by_collisions);
  }
};

// With whole-stress friction collisions shear by no more than the law has for what they bear, and contacts by
// the law of all that is borne; expansion meets the bulk viscosity as ever. Slow shear leaves the kinetic
// viscosity what it is.
TEST(Friction, OfTheWholeStress) {
  constexpr double viscosity = 20.0, contacts = 100.0, collisions = 50.0;  // [Pa s], [Pa], [Pa]
  Scene scene = box_scene(2, {4, 6, 1}, {0.4, 0.6, 1.0});
  make_periodic(scene, 0);
  scene.model.friction_law = FrictionLaw::of<closures::FrictionInertial>();
  scene.solid.friction = 0.4;
  ShearedBed alone(scene, contacts + collisions, 0.0, 0.0);
  scene.model.whole_stress_friction = true;
  ShearedBed bed(scene, contacts, collisions, viscosity);
  const auto bounded = [&](double norm) {
    const double mu = closures::FrictionInertial::coefficient({contacts + collisions, norm, 0.0}, scene.solid,
                                                              scene.contact);
    return std::min(viscosity, 0.5 * mu * collisions / norm);
  };
  Field spent(bed.s.grid);
  const std::ptrdiff_t middle = bed.s.grid.cells.index(1, 2, 0);
  for (const double rate : {10.0, 0.5}) {
    const double of_contacts = alone.spends(rate, 0.0, spent).friction * contacts / (contacts + collisions);
    const double shear = bounded(0.5 * rate);
    EXPECT_EQ(shear<viscosity, rate> 1.0);
    EXPECT_NEAR(bed.spends(rate, 0.0, spent).friction, of_contacts, 1e-5 * of_contacts);
    EXPECT_NEAR(spent[middle], shear * rate * rate, 1e-6 * shear * rate * rate);
    EXPECT_NEAR(bed.friction.yields_otherwise(bed.rheology, bed.next).share, 0.0, 1e-5);
  }
  constexpr double rate = 10.0, expansion = 4.0;  // [1/s]
  const double shear = bounded(std::sqrt(0.5 * (0.5 * rate * rate + expansion * expansion)));
  const double bulk = 5.0 / 3.0 * viscosity - 2.0 / 3.0 * shear;
  const double all = shear * rate * rate + (2.0 * shear + bulk) * expansion * expansion;
  bed.spends(rate, expansion, spent);
  EXPECT_NEAR(spent[middle], all, 1e-6 * all);
}

// A layer sheared at twice the rate that the viscosities were taken at: all of (17) is spent twice. Where the
// regularisation bears it the viscosity does not know the rate, and nothing is missed.
TEST(Friction, WhatItsViscositiesMiss) {
  for (const bool regularised : {false, true}) {
    Scene scene = box_scene(2, {4, 6, 1}, {0.4, 0.6, 1.0});
    make_periodic(scene, 0);
    scene.contact.regularisation = regularised ? 1e-6 : 1e5;
    Bed bed(scene);
    bed.rheology.enduring_pressure.fill(100.0);
    const auto shear = [&](double rate) {
      return bed.s.faces({[=](const Vec3& x) { return rate * x[1]; }, [](const Vec3&) { return 0.0; },
                          [](const Vec3&) { return 0.0; }});
    };
    bed.u = bed.u_strain = shear(3.0);
    for (int d = 0; d < 2; ++d) bed.mass[d].fill(1e9);
    bed.rhs = bed.u;
    for (int d = 0; d < 2; ++d)
      bed.s.each_cell([&](int, int, int, std::ptrdiff_t c) { bed.rhs[d][c] *= 1e9; });
    bed.solve();  // so heavy that nothing moves
    const auto missed = [&](double rate) {
      bed.next.u_s = shear(rate);
      return bed.friction.yields_otherwise(bed.rheology, bed.next).share;
    };
    EXPECT_NEAR(missed(3.0), 0.0, 1e-6);
    EXPECT_NEAR(missed(6.0), regularised ? 0.0 : 1.0, 1e-3);
    EXPECT_NEAR(missed(1.5), regularised ? 0.0 : 0.5, 1e-3);
  }
}

}  // namespace
}  // namespace granvof
