// Operators on the slabs of several processes, where what one does not know of its neighbour decides.
#include <gtest/gtest.h>

#include "solver/operators/interface_transport.hpp"
#include "solver/run/step_control.hpp"
#include "solver/tests/operators/tank.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using test::Tank;

Scene wide() {
  return test::box_scene(2, {16, 6, 1}, {1.6, 0.6, 1.0});
}

// work(slab) in each of so many processes.
template <typename Work>
void in_slabs(int processes, const Scene& scene, Work&& work) {
  test::Team team(processes, test::Boxes::slabs);
  ASSERT_NO_THROW(team.run([&](int, const Communicator& communicator) {
    Tank slab(scene, &communicator);
    work(slab);
  }));
}

// The fastest face of all, wherever it is.
TEST(CutTank, TakesTheStepOfItsFastestProcess) {
  const Scene scene = wide();
  for (const int fast : {2, 9, 15}) {
    const auto next = [&](const Tank& t) {
      State state = t.uniform_state(0.1);
      t.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
        state.u_c[0][c] = t.grid.cells.first[0] + i == fast && j == 2 ? 1e4 : 1.0;
      });
      return StepControl(t.grid, t.scene, closures::SolidLaw(t.scene)).next(state);
    };
    const double expected = next(Tank(scene));
    for (const int processes : {2, 3})
      in_slabs(processes, scene, [&](const Tank& slab) { EXPECT_EQ(next(slab), expected) << fast; });
  }
}

// An upright front on, before and behind the cuts, and the limiter at work on both of its sides.
TEST(CutTank, CarriesAFrontAcrossItsCuts) {
  const Scene scene = wide();
  constexpr double dt = 0.02;
  const auto carried = [&](const Tank& t, int front) {
    State now = t.uniform_state(0.0), next = now;
    FaceField flux(t.grid);
    t.each(t.grid.inner_faces(0), [&](int i, int, int, std::ptrdiff_t c) {
      flux[0][c] = 1.0 + 0.3 * std::sin(1.7 * (t.grid.cells.first[0] + i));
    });
    t.boundary.exchange(flux[0]);
    t.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
      const int column = t.grid.cells.first[0] + i;
      now.alpha[c] = column < front ? 1.0 : column == front ? 0.1 + 0.15 * j : 0.0;
    });
    t.boundary.fill_liquid_share(now.alpha);
    InterfaceTransport interface(t.grid, t.scene, t.boundary);
    interface.advance(dt, now, flux, next);
    return next.alpha;
  };
  const Tank whole(scene);
  for (int front = 3; front < 13; ++front) {
    const Field expected = carried(whole, front);
    for (const int processes : {2, 3, 4})
      in_slabs(processes, scene, [&](const Tank& slab) {
        const Field alpha = carried(slab, front);
        slab.each_cell([&](int i, int j, int, std::ptrdiff_t c) {
          EXPECT_NEAR(alpha[c], expected[whole.grid.cells.index(slab.grid.cells.first[0] + i, j, 0)], 1e-14)
              << "front " << front << ", column " << i << " of process "
              << slab.grid.cells.communicator->rank();
        });
      });
  }
}

}  // namespace
}  // namespace granvof
