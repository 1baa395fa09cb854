// Inertia of both phases and the drag coefficient on faces, against the closures on known states.
#include <gtest/gtest.h>

#include "solver/closures/drag/drag.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/operators/interphase_drag.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof {
namespace {

using test::Tank;
using test::unit_scene;

std::array<Tank::Function, 3> constant(double a, double b, double c) {
  return {[=](const Vec3&) { return a; }, [=](const Vec3&) { return b; }, [=](const Vec3&) { return c; }};
}

TEST(FaceInertia, MeanRoomTimesMeanDensityOfTheTwoCells) {
  for (int dim : {2, 3}) {
    const Tank s(unit_scene(dim, 4));
    const Field f_s = s.cells([](const Vec3& x) { return x[0] < 0.5 ? 0.6 : 0.2; });
    const Field alpha = s.cells([](const Vec3& x) { return x[0] < 0.5 ? 1.0 : 0.25; });
    FaceInertia inertia(s.grid);
    inertia.update(s.grid, s.scene, f_s, alpha);
    const double left = 1000.0, right = 0.25 * 1000.0 + 0.75 * 1.0;
    for (int d = 0; d < dim; ++d)
      s.each(s.grid.cells_and_ghosts(1), [&](int i, int, int, std::ptrdiff_t c) {
        const double share = d == 0 && i == 2 ? 0.5 : (i < 2 ? 1.0 : 0.0);  // of the left side
        const double f = share * 0.6 + (1.0 - share) * 0.2;
        EXPECT_NEAR(inertia.f_s[d][c], f, 1e-15);
        EXPECT_NEAR(inertia.solid[d][c], 2500.0 * f, 1e-10);
        EXPECT_NEAR(inertia.fluid[d][c], (1.0 - f) * (share * left + (1.0 - share) * right), 1e-10);
      });
  }
}

struct Dragged {
  Dragged(int dim, bool drag, double f_s, double alpha) : s(scene_of(dim, drag)), drag_(s.grid, s.scene) {
    State state = s.uniform_state(f_s, alpha);
    state.u_s = s.faces(constant(0.1, -0.2, 0.05));
    state.u_c = s.faces(constant(0.4, 0.2, -0.15));
    FaceInertia inertia(s.grid);
    inertia.update(s.grid, s.scene, state.f_s, state.alpha);
    drag_.update(s.boundary, state, inertia, Rheology(s.grid));
  }
  static Scene scene_of(int dim, bool drag) {
    Scene scene = unit_scene(dim, 4);
    scene.model.drag = drag;
    return scene;
  }
  void expect(double value) const {
    for (int d = 0; d < s.grid.dim; ++d)
      s.each(s.grid.inner_faces(d), [&](int, int, int, std::ptrdiff_t c) {
        EXPECT_NEAR(drag_.beta()[d][c], value, 1e-12 * std::fabs(value));
      });
  }
  Tank s;
  InterphaseDrag drag_;
};

TEST(InterphaseDrag, UsesTheWholeSlipOfAUniformState) {
  for (int dim : {2, 3}) {
    const double slip = std::sqrt(0.3 * 0.3 + 0.4 * 0.4 + (dim == 3 ? 0.2 * 0.2 : 0.0));
    for (double f_s : {0.57, 0.05})
      for (double alpha : {1.0, 0.0, 0.3}) {
        const Dragged d(dim, true, f_s, alpha);
        const double beta = closures::drag_coefficient(closures::drag_paper, f_s, alpha, slip, d.s.scene.gas,
                                                       d.s.scene.liquid, d.s.scene.solid.diameter);
        ASSERT_GT(beta, 0.0);
        d.expect(beta);
      }
  }
}

TEST(InterphaseDrag, ZeroWithoutGrainsAndWhereSwitchedOff) {
  Dragged(2, true, 0.0, 1.0).expect(0.0);
  Dragged(2, true, 1e-7, 1.0).expect(0.0);
  Dragged(2, false, 0.5, 1.0).expect(0.0);
}

TEST(InterphaseDrag, IsForgottenWhereTheGrainsLeft) {
  Dragged d(2, true, 0.5, 1.0);
  const State empty = d.s.uniform_state(0.0);
  FaceInertia inertia(d.s.grid);
  inertia.update(d.s.grid, d.s.scene, empty.f_s, empty.alpha);
  d.drag_.update(d.s.boundary, empty, inertia, Rheology(d.s.grid));
  d.expect(0.0);
}

// Clear fluid over grains at the face between two cells. With the second-order flux grains that fall are
// hindered as those below them, grains that rise as the lone ones above; the paper's scheme takes the mean.
TEST(InterphaseDrag, IsHinderedAsInTheCellTheGrainsMoveInto) {
  const double below = 0.4, mean = 0.2;
  const auto beta_at = [&](SlopeLimiter flux, double slip) {
    Scene scene = unit_scene(2, 4);
    scene.numerics.transport_scheme = flux;
    const Tank s(scene);
    State state = s.uniform_state(0.0);
    state.f_s = s.cells([=](const Vec3& x) { return x[1] < 0.5 ? below : 0.0; });
    state.u_c = s.faces(constant(0.0, slip, 0.0));
    FaceInertia inertia(s.grid);
    inertia.update(s.grid, s.scene, state.f_s, state.alpha);
    InterphaseDrag drag(s.grid, s.scene);
    drag.update(s.boundary, state, inertia, Rheology(s.grid));
    return drag.beta()[1][s.grid.cells.index(1, 2, 0)];
  };
  const Tank s(unit_scene(2, 4));
  const auto law = [&](double f) {
    return closures::drag_paper(f, 0.3, s.scene.liquid, s.scene.solid.diameter) / (f * (1.0 - f)) * mean *
           (1.0 - mean);
  };
  EXPECT_NEAR(beta_at(SlopeLimiter::of<closures::LimiterNone>(), 0.3), law(mean), 1e-12 * law(mean));
  for (const SlopeLimiter flux :
       {SlopeLimiter::of<closures::LimiterVanLeer>(), SlopeLimiter::of<closures::LimiterSuperbee>()}) {
    EXPECT_NEAR(beta_at(flux, 0.3), law(below), 1e-12 * law(below));
    EXPECT_NEAR(beta_at(flux, -0.3), law(1e-12), 1e-9 * law(1e-12));
    EXPECT_NEAR(beta_at(flux, 0.0), closures::drag_paper(mean, 0.0, s.scene.liquid, s.scene.solid.diameter),
                1e-9 * law(mean));
  }
}

// Faces of a column: f_s 0.5 whose share of 0.4 rests, below 0.1. The fluid moves what does not rest,
// hindered by no more than that; horizontal faces and the centres of cells know nothing of it.
TEST(Drag, GrainsAtRestAreNotDraggedByTheFluidAboveThem) {
  const Tank s(unit_scene(2, 4));
  State state = s.uniform_state(0.0);
  state.f_s = s.cells([](const Vec3& x) { return x[1] < 0.5 ? 0.5 : 0.1; });
  FaceInertia inertia(s.grid);
  inertia.update(s.grid, s.scene, state.f_s, state.alpha);
  const std::ptrdiff_t below = s.grid.cells.index(1, 1, 0), above = s.grid.cells.index(1, 2, 0);
  const auto beta = [&](double at_rest, std::ptrdiff_t cell, int d, double held = 0.0, double on_top = 0.0) {
    Rheology rest(s.grid);
    rest.part_cells.at_rest[cell] = at_rest;
    rest.part_cells.held[cell] = held;
    rest.free_side[cell] = at_rest > 0.0 ? 1.0 : at_rest < 0.0 ? -1.0 : 0.0;
    if (on_top > 0.0) rest.part_cells.at_rest[above] = on_top;
    InterphaseDrag drag(s.grid, s.scene);
    drag.update(s.boundary, state, inertia, rest);
    return std::pair(drag.beta()[d][s.grid.cells.index(1, 2, 0)],
                     drag.beta_of_cells()[s.grid.cells.index(1, 1, 0)]);
  };
  const auto law = [&](double f) {
    double value = 0.0;
    DragLaw::of<closures::DragPaper>().with([&](auto paper) {
      value =
          closures::drag_coefficient(paper, f, 1.0, 0.0, s.scene.gas, s.scene.liquid, s.scene.solid.diameter);
    });
    return value;
  };
  const auto of = [&](double moving) { return law(moving) * (1.0 - 0.3) / (1.0 - moving); };
  EXPECT_NEAR(beta(0.0, below, 1).first, of(0.3), 1e-12 * of(0.3));
  EXPECT_NEAR(beta(0.4, below, 1).first, of(0.1), 1e-12 * of(0.1));
  EXPECT_NEAR(beta(-0.4, above, 1).first, of(0.1), 1e-12 * of(0.1));  // pressed upwards
  EXPECT_NEAR(beta(0.6, below, 1).first, of(0.015), 1e-12 * of(0.015));
  EXPECT_NEAR(beta(0.4, below, 1, 1.0).first, of(0.3), 1e-12 * of(0.3));  // nothing falls: the bed's own
  EXPECT_NEAR(beta(0.4, above, 1).first, of(0.3), 1e-12 * of(0.3));       // what rests above is no free face
  EXPECT_EQ(beta(0.4, below, 0).first, beta(0.0, below, 0).first);
  EXPECT_NEAR(beta(0.4, below, 1, 0.0, 0.5).first, of(0.3), 1e-12 * of(0.3));  // never more than there are
  EXPECT_NEAR(beta(0.4, below, 1).second, law(0.5), 1e-12 * law(0.5));
}

// A packed cell that others fill in part lies on has no free face: what rests there is held by its own
// pressure and dragged as a whole. (Taken for one with more at rest above than below, the face had three
// times its grains' drag, and a bed that water came through 1.8 times Ergun's pressure.)
TEST(Drag, APackedCellHasNoFreeFace) {
  const Tank s(unit_scene(2, 4));
  State state = s.uniform_state(0.0);
  state.f_s = s.cells([](const Vec3& x) { return x[1] < 0.5 ? 0.572 : 0.54; });
  FaceInertia inertia(s.grid);
  inertia.update(s.grid, s.scene, state.f_s, state.alpha);
  const auto beta = [&](double below, double above) {
    Rheology rest(s.grid);
    rest.part_cells.at_rest[s.grid.cells.index(1, 1, 0)] = below;
    rest.part_cells.at_rest[s.grid.cells.index(1, 2, 0)] = above;
    InterphaseDrag drag(s.grid, s.scene);
    drag.update(s.boundary, state, inertia, rest);
    return drag.beta()[1][s.grid.cells.index(1, 2, 0)];
  };
  EXPECT_EQ(beta(0.03, 0.54), beta(0.0, 0.0));
  EXPECT_EQ(beta(0.37, 0.2), beta(0.0, 0.0));
}

}  // namespace
}  // namespace granvof
