// A solve by two processes is the solve of both their boxes in one: layers of a box that are not coupled.
#include <memory>

#include <gtest/gtest.h>

#include "solver/linear/conjugate_gradient.hpp"
#include "solver/linear/scalar_solver.hpp"
#include "solver/tests/linear/problem.hpp"
#include "solver/tests/team.hpp"

namespace granvof::linear::testing {
namespace {

constexpr std::array<int, 3> layer{17, 12, 1};
const Tolerance few{0.0, 1e-30, 3};  // iterations, long before both would have the answer

// Masses and faces of very different size in the two layers: a step length of one of them would not do for
// the other.
double size_of(int k) {
  return k == 0 ? 1.0 : 100.0;
}

struct Problem {
  Problem(std::array<int, 3> n, int first) : box(n), mass(box.values()), rhs(box.values()), x(box.values()) {
    std::array<Values, 3> lower{box.values(), box.values(), box.values()};
    box.each([&](int i, int j, int k) {
      const std::ptrdiff_t c = box.layout.index(i, j, k);
      const int number = i + layer[0] * (j + layer[1] * (k + first));
      mass[c] = size_of(k + first) * (0.01 + 0.1 * ((number * 7) % 5));
      rhs[c] = ((number * 13) % 11) - 5.0;
      lower[0][c] = i == 0 ? 0.0 : size_of(k + first) * (1.0 + (number * 3) % 4);
      lower[1][c] = j == 0 ? 0.0 : 1.0 + (number * 5) % 3;
    });
    for (int d = 0; d < 2; ++d) {
      coefficient[d] = lower[d];
      faces.lower[d] = coefficient[d].data();
    }
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  Box box;
  Values mass, rhs, x;
  std::array<Values, 2> coefficient;
  Faces faces{};
};

void expect_layers(const Problem& whole, const std::array<std::unique_ptr<Problem>, 2>& parts) {
  double largest = 0.0;
  whole.box.each([&](int i, int j, int k) {
    const double there = whole.x[whole.box.layout.index(i, j, k)];
    const Problem& part = *parts[static_cast<std::size_t>(k)];
    const double here = part.x[part.box.layout.index(i, j, 0)];
    largest = std::max(largest, std::fabs(there));
    EXPECT_NEAR(here, there, 1e-6 * std::fabs(there) + 1e-9) << i << ' ' << j << ' ' << k;
  });
  EXPECT_GT(largest, 1e-3);
}

// solve(problem, layout that the solver is made for) in both worlds.
template <typename Solve>
void compare(Solve&& solve) {
  Problem whole({layer[0], layer[1], 2}, 0);
  const Report one = solve(whole);
  std::array<std::unique_ptr<Problem>, 2> parts;
  std::array<Report, 2> reports;
  test::Team team(2);
  team.run([&](int number, const Communicator& communicator) {
    const auto n = static_cast<std::size_t>(number);
    parts[n] = std::make_unique<Problem>(layer, number);
    parts[n]->box.layout.communicator = &communicator;
    reports[n] = solve(*parts[n]);
  });
  EXPECT_EQ(one.iterations, 3);
  for (const Report& report : reports) {
    EXPECT_EQ(report.iterations, one.iterations);
    EXPECT_DOUBLE_EQ(report.initial, one.initial);
    EXPECT_NEAR(report.final, one.final, 1e-6 * one.final);
  }
  EXPECT_EQ(reports[0].final, reports[1].final);
  expect_layers(whole, parts);
}

TEST(SolveByProcesses, ScalarSystem) {
  compare([](Problem& p) {
    ScalarSolver solver(p.box.layout);
    return solver.solve(p.faces, p.mass.data(), p.rhs.data(), p.x.data(), few);
  });
}

TEST(SolveByProcesses, ConjugateGradientsOverTwoComponents) {
  compare([](Problem& p) {
    const Layout& l = p.box.layout;
    Values second = p.box.values();  // another component of the same system, alone with its mass
    ConjugateGradient solver({l, l});
    const auto apply = [&](const Components& v, const Components& out) {
      for (int c = 0; c < 2; ++c)
        p.box.each([&](int i, int j, int k) {
          const std::ptrdiff_t at = l.index(i, j, k);
          double sum = p.mass[at] * v[c][at];
          const std::array<int, 3> place{i, j, k};
          for (int d = 0; d < 2 && c == 0; ++d) {
            const std::ptrdiff_t s = l.stride[d];
            if (place[d] > 0) sum += p.coefficient[d][at] * (v[c][at] - v[c][at - s]);
            if (place[d] + 1 < l.n[d]) sum += p.coefficient[d][at + s] * (v[c][at] - v[c][at + s]);
          }
          out[c][at] = sum;
        });
    };
    const auto precondition = [&](const ConstComponents& r, const Components& z) {
      for (int c = 0; c < 2; ++c)
        p.box.each([&](int i, int j, int k) { z[c][l.index(i, j, k)] = r[c][l.index(i, j, k)]; });
    };
    return solver.solve(apply, precondition, {p.rhs.data(), p.rhs.data(), nullptr},
                        {p.x.data(), second.data(), nullptr}, few);
  });
}

TEST(SolveByProcesses, CoupledSystem) {
  compare([](Problem& p) {
    CoupledSolver solver(p.box.layout);
    CoupledSystem system{};
    std::array<Values, 2> half;
    for (int d = 0; d < 2; ++d) {
      half[d] = p.coefficient[d];
      for (double& a : half[d]) a *= 0.5;
      system.k11[d] = system.k22[d] = p.coefficient[d].data();
      system.k12[d] = system.k21[d] = half[d].data();
    }
    system.m11 = system.m22 = p.mass.data();
    system.rhs1 = system.rhs2 = p.rhs.data();
    Values second = p.box.values();
    return solver.solve(system, p.x.data(), second.data(), few);
  });
}

}  // namespace
}  // namespace granvof::linear::testing
