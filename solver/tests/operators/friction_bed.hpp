// A box of grains with all that the friction solve takes, each field open to be set.
#pragma once

#include <gtest/gtest.h>

#include "solver/operators/friction.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof::test {

constexpr double step = 1e-3;  // [s]

struct Bed {
  explicit Bed(Scene given)
      : s(std::move(given)),
        aperture(s.grid, s.scene),
        inertia(s.grid),
        rheology(s.grid),
        balance(s.grid),
        now(s.grid),
        next(s.grid),
        friction(s.grid, s.scene, s.boundary) {
    f_s.fill(0.5);
  }
  void fill() {
    s.boundary.fill_scalar(f_s);
    inertia.update(s.grid, s.scene, f_s, Field(s.grid, 1.0));
    s.boundary.fill_scalar(rheology.kinetic_viscosity);
    s.boundary.fill_scalar(rheology.enduring_pressure);
    if (!rheology.kinetic_pressure.empty()) s.boundary.fill_scalar(rheology.kinetic_pressure);
  }
  // The operator stops at a residual of 1e-9 m/s over the face's mass, or at 1e-6 of the first one: a few
  // calls, each from the last one's answer, reach the former.
  void solve() {
    fill();
    s.boundary.fill_velocity(u_strain, Phase::solid);
    linear::Report report;
    for (int i = 0; i < 6; ++i) report = friction.solve(balance, inertia, aperture, rheology, now, next);
    EXPECT_TRUE(report.converged) << report.initial << ' ' << report.final;
  }
  // Of the last solve, as if it had been solved for the velocity `of` and the step had led to `at`.
  Friction::Power power(const FaceField& of, const FaceField& at, Field& kinetic) {
    State state(s.grid);
    state.u_strain = of;
    state.u_s = at;
    return friction.power(mass, state, kinetic);
  }
  Tank s;
  Aperture aperture;
  FaceInertia inertia;
  Rheology rheology;
  SolidBalance balance;
  State now, next;
  FaceField &mass = balance.mass, &rhs = balance.rhs, &u_strain = now.u_strain, &u = next.u_s;
  Field& f_s = now.f_s;
  Friction friction;
};

// A layer, periodic in x, loaded in x alone.
struct Layer : Bed {
  explicit Layer(const Scene& scene) : Bed(scene) {}
  static Scene between(WallKind lower, WallKind upper) {
    Scene scene = box_scene(2, {4, 16, 1}, {0.04, 0.16, 1.0}, WallKind::slip);
    make_periodic(scene, 0);
    scene.sides[bottom].solid.kind = lower;
    scene.sides[top].solid.kind = upper;
    return scene;
  }
  void set(double mass_value, double force) {
    mass[0].fill(mass_value);
    mass[1].fill(mass_value);
    s.each(s.grid.inner_faces(0), [&](int, int, int, std::ptrdiff_t c) { rhs[0][c] = force; });
  }
};

}  // namespace granvof::test
