// Systems of a box that is cut among processes, against the same of the box in one piece.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solver/grid/for_each.hpp"
#include "solver/grid/whole_box.hpp"
#include "solver/linear/coupled_solver.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/linear/scalar_solver.hpp"
#include "solver/tests/cut_box.hpp"

namespace granvof::linear::testing {
namespace {

using test::Cut;

using Values = std::vector<double>;

// Of the whole box: coefficients of very different size, without rhs in the mean where there is no mass.
struct System {
  explicit System(const Layout& l) : layout(l), mass(l.size), rhs(l.size), x(l.size) {
    for (auto& face : lower) face = Values(l.size);
    double sum = 0.0;
    for_each_place(Range::all(l), [&](const std::array<int, 3>& at) {
      const auto c = static_cast<std::size_t>(l.index(at));
      const int number = at[0] * 7 + at[1] * 13 + at[2] * 5;
      mass[c] = number % 3 == 0 ? 0.3 : 0.0;
      rhs[c] = (number % 11) - 5.0;
      sum += rhs[c];
      for (int d = 0; d < 3; ++d)
        if (l.n[d] > 1 && (at[d] > 0 || l.periodic[d]))
          lower[d][c] = (1.0 + (number * (d + 1)) % 4) * (at[0] % 17 < 4 ? 1e3 : 1.0);
    });
    for_each_place(Range::all(l), [&](const std::array<int, 3>& at) {
      rhs[static_cast<std::size_t>(l.index(at))] -= sum / static_cast<double>(l.count());
    });
  }
  Faces faces() const {
    Faces f{};
    for (int d = 0; d < 3; ++d)
      if (layout.whole[d] > 1) f.lower[d] = lower[d].data();
    return f;
  }
  // The part of a process, with its neighbours' faces.
  System part(const Layout& l) const {
    System own(l);
    const WholeBox box(l, layout, WholeBox::Values::box);
    for (auto values : {&System::mass, &System::rhs, &System::x})
      box.take((this->*values).data(), (own.*values).data());
    for (int d = 0; d < 3; ++d) {
      box.take(lower[d].data(), own.lower[d].data());
      exchange(l, own.lower[d].data());
    }
    return own;
  }

  Layout layout;
  Values mass, rhs, x;
  std::array<Values, 3> lower;
};

class CutSystem : public ::testing::TestWithParam<Cut> {
 protected:
  // solve(system) gives the values that are compared: of the whole, and of every process's part collected.
  template <typename Solve>
  void compare(double tolerance, Solve&& solve) {
    const Cut& cut = GetParam();
    const Layout whole = Layout::make(cut.n, {1, cut.n[1] > 1 ? 1 : 0, cut.n[2] > 1 ? 1 : 0}, cut.periodic);
    System one(whole);
    const Values expected = solve(one);
    double largest = 0.0;
    for (const double v : expected) largest = std::max(largest, std::fabs(v));
    ASSERT_GT(largest, 0.0);
    const System given(whole);
    test::in_all_slabs(cut, whole, [&](const Layout& l) {
      System own = given.part(l);
      const Values part = solve(own);
      Values all(whole.size);
      WholeBox(l, whole, WholeBox::Values::box).collect(part.data(), all.data(), true);
      double off = 0.0;
      for_each_place(Range::all(whole), [&](const std::array<int, 3>& at) {
        const auto c = static_cast<std::size_t>(whole.index(at));
        off = std::max(off, std::fabs(all[c] - expected[c]));
      });
      EXPECT_LE(off, tolerance * largest) << "process " << l.communicator->rank();
    });
  }
};

TEST_P(CutSystem, HasTheVCycleOfTheWholeToTheBit) {
  compare(0.0, [](System& s) {
    Multigrid multigrid(s.layout);
    multigrid.set(s.faces(), s.mass.data());
    multigrid.apply(s.rhs.data(), s.x.data(), 3);
    return s.x;
  });
}

TEST_P(CutSystem, IsSolvedByConjugateGradients) {
  compare(1e-9, [](System& s) {
    ScalarSolver solver(s.layout);
    EXPECT_TRUE(
        solver.solve(s.faces(), s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-12, 200}).converged);
    return s.x;
  });
}

TEST_P(CutSystem, OfTwoPressuresIsSolved) {
  compare(1e-8, [](System& s) {
    CoupledSolver solver(s.layout);
    std::array<Values, 3> half = s.lower;
    CoupledSystem system{};
    for (int d = 0; d < 3; ++d) {
      if (s.layout.whole[d] == 1) continue;
      for (double& a : half[d]) a *= 0.5;
      system.k11[d] = system.k22[d] = s.lower[d].data();
      system.k12[d] = system.k21[d] = half[d].data();
    }
    system.m11 = system.m22 = s.mass.data();
    system.rhs1 = system.rhs2 = s.rhs.data();
    Values second(s.layout.size);
    EXPECT_TRUE(solver.solve(system, s.x.data(), second.data(), {0.0, 1e-11, 400}).converged);
    return s.x;
  });
}

// Some have levels that stay cut, ends of an odd number of rows, and slabs that no pair of rows fits.
INSTANTIATE_TEST_SUITE_P(
    Boxes, CutSystem,
    ::testing::Values(Cut{"gathered_at_once", {23, 12, 1}, 2, {false, false, false}, 2},
                      Cut{"three_levels_stay_cut", {257, 130, 1}, 2, {false, false, false}, 2},
                      Cut{"among_three", {255, 66, 1}, 2, {false, false, false}, 3},
                      Cut{"a_ring_of_two", {192, 64, 1}, 2, {true, false, false}, 2},
                      Cut{"a_ring_of_three_in_a_ring", {190, 64, 1}, 2, {true, true, false}, 3},
                      Cut{"across_z", {20, 12, 66}, 3, {false, false, true}, 3},
                      Cut{"across_x_in_three_dimensions", {66, 12, 20}, 3, {false, false, true}, 2}),
    test::name_of_cut);

}  // namespace
}  // namespace granvof::linear::testing
