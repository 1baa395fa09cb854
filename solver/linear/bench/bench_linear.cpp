// Cost of the linear solvers, microseconds per cell per solve with set-up, one line per problem and grid
// size.
//
//   OMP_NUM_THREADS=1 bench_linear [repeats]
//
// Pressure: liquid below gas, drops and bubbles, density 1:1000, closed box, to 1e-6. Friction: a
// mass-dominated field around a bed of coefficients up to 1e10 times larger, to 1e-6. Coupled: a column of
// grains in water under air with an open top, to 1e-3 (what a time step asks for) and 1e-6. Time is that of
// this thread's core, the median and the least of `repeats` (9) samples.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <vector>

#include "solver/linear/coupled_solver.hpp"
#include "solver/linear/scalar_solver.hpp"

using namespace granvof;
using namespace granvof::linear;

namespace {

using Values = std::vector<double>;

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Layout box(std::array<int, 3> n) {
  return Layout::make(n, {1, n[1] > 1 ? 1 : 0, n[2] > 1 ? 1 : 0}, {false, false, false});
}

// visit(index, x, y, z) with coordinates in (0, 1)
void each(const Layout& l, const std::function<void(std::ptrdiff_t, double, double, double)>& visit) {
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i)
        visit(l.index(i, j, k), (i + 0.5) / l.n[0], (j + 0.5) / l.n[1], (k + 0.5) / l.n[2]);
}

struct Scalar {
  explicit Scalar(std::array<int, 3> n)
      : layout(box(n)), mass(layout.size), rhs(layout.size), x(layout.size) {
    for (int d = 0; d < 3; ++d)
      if (n[d] > 1) {
        face[d].resize(layout.size);
        faces.lower[d] = face[d].data();
      }
  }
  // faces from values of the two cells
  void set_faces(const Values& cell, const std::function<double(double, double)>& between) {
    for (int d = 0; d < 3; ++d) {
      if (!faces.lower[d]) continue;
      for (int k = 0; k < layout.n[2]; ++k)
        for (int j = 0; j < layout.n[1]; ++j)
          for (int i = 0; i < layout.n[0]; ++i) {
            const std::array<int, 3> at{i, j, k};
            const std::ptrdiff_t c = layout.index(i, j, k);
            face[d][c] = at[d] == 0 ? 0.0 : between(cell[c], cell[c - layout.stride[d]]);
          }
    }
  }
  Layout layout;
  std::array<Values, 3> face;
  Faces faces;
  Values mass, rhs, x;
};

Scalar pressure(std::array<int, 3> n) {
  Scalar s(n);
  Values rho(s.layout.size);
  const double h2 = double(n[0]) * n[0];
  each(s.layout, [&](std::ptrdiff_t c, double x, double y, double z) {
    const double zz = n[2] > 1 ? z - 0.5 : 0.0;
    bool liquid = y < 0.5 + 0.1 * std::sin(6.0 * x);
    if (std::hypot(x - 0.3, y - 0.25, zz) < 0.12) liquid = false;
    if (std::hypot(x - 0.7, y - 0.8, zz) < 0.1) liquid = true;
    rho[c] = liquid ? 1000.0 : 1.0;
  });
  s.set_faces(rho, [&](double a, double b) { return h2 * 2.0 / (a + b); });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  double mean = 0.0;
  each(s.layout, [&](std::ptrdiff_t c, double x, double y, double) {
    s.rhs[c] = std::cos(3.0 * x) * std::cos(5.0 * y) + noise(random);
    mean += s.rhs[c];
  });
  mean /= double(s.layout.count());
  each(s.layout, [&](std::ptrdiff_t c, double, double, double) { s.rhs[c] -= mean; });
  return s;
}

Scalar friction(std::array<int, 3> n) {
  Scalar s(n);
  Values mu(s.layout.size);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  each(s.layout, [&](std::ptrdiff_t c, double x, double y, double) {
    const bool bed = x < 0.4 && y < 0.6;
    mu[c] = bed ? std::pow(10.0, 4.0 + std::sin(20.0 * x) * std::cos(17.0 * y)) : 1e-5;
    s.mass[c] = 1.0;
    s.rhs[c] = std::sin(4.0 * x) + 0.5 * noise(random);
  });
  s.set_faces(mu, [](double a, double b) { return 0.5 * (a + b); });
  return s;
}

struct Coupled {
  explicit Coupled(std::array<int, 3> n) : first(n) {
    const Layout& l = first.layout;
    Values fs(l.size), rho(l.size);
    rhs2.resize(l.size);
    m22.resize(l.size);
    const double dt = 3e-3, dx = 0.4 / n[0];
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    each(l, [&](std::ptrdiff_t c, double x, double y, double) {
      const bool bed = x < 0.3 && y < 0.6;
      fs[c] = bed ? 0.57 + 0.02 * std::sin(30.0 * x) * std::sin(20.0 * y) : 0.0;
      rho[c] = y < 0.75 ? 1000.0 : 1.2;
      const double stiffness = bed ? 1e4 * std::pow(10.0, 2.0 * std::cos(9.0 * x)) : 1.0;
      m22[c] = 1.0 / (stiffness * dt);
      first.rhs[c] = 0.1 * (std::sin(5.0 * x) + noise(random));
      rhs2[c] = bed ? std::cos(7.0 * y) + noise(random) : 0.0;
    });
    for (int d = 0; d < 3; ++d) {
      if (!first.faces.lower[d]) continue;
      for (auto* k : {&k11, &k12, &k21, &k22}) (*k)[d].resize(l.size);
      for (int kk = 0; kk < n[2]; ++kk)
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i) {
            const std::array<int, 3> at{i, j, kk};
            if (at[d] == 0) continue;
            const std::ptrdiff_t c = l.index(i, j, kk), o = c - l.stride[d];
            const double f = 0.5 * (fs[c] + fs[o]), g = 1.0 - f, r = 0.5 * (rho[c] + rho[o]);
            const double up_s = fs[c], up_c = 1.0 - fs[c];
            const double beta = 150.0 * 1e-3 * f * f / (g * 1e-6), mc = g * r / dt, ms = f * 2500.0 / dt;
            if (f < 1e-6) {
              k11[d][c] = up_c * g / mc / (dx * dx);
              continue;
            }
            const double det = (mc + beta) * (ms + beta) - beta * beta;
            const double i11 = (ms + beta) / det, i12 = beta / det, i22 = (mc + beta) / det;
            k11[d][c] = (up_c * (i11 * g + i12 * f) + up_s * (i12 * g + i22 * f)) / (dx * dx);
            k12[d][c] = (up_c * i12 + up_s * i22) / (dx * dx);
            k21[d][c] = up_s * (i12 * g + i22 * f) / (dx * dx);
            k22[d][c] = up_s * i22 / (dx * dx);
          }
      system.k11[d] = k11[d].data();
      system.k12[d] = k12[d].data();
      system.k21[d] = k21[d].data();
      system.k22[d] = k22[d].data();
    }
    for (int kk = 0; kk < n[2]; ++kk)
      for (int i = 0; i < n[0]; ++i) {  // open top
        const std::ptrdiff_t c = l.index(i, n[1] - 1, kk);
        first.mass[c] = 2.0 * dt / rho[c] / (dx * dx);
      }
    system.m11 = first.mass.data();
    system.m22 = m22.data();
    system.rhs1 = first.rhs.data();
    system.rhs2 = rhs2.data();
  }
  Scalar first;
  std::array<Values, 3> k11, k12, k21, k22;
  Values m22, rhs2;
  CoupledSystem system;
};

void measure(const char* name, const std::array<int, 3>& n, int repeats,
             const std::function<Report()>& solve) {
  const double cells = double(n[0]) * n[1] * n[2];
  const int batch = std::max(1, static_cast<int>(4e5 / cells));
  Report report = solve();
  std::vector<double> samples;
  for (int r = 0; r < repeats; ++r) {
    const double start = seconds();
    for (int b = 0; b < batch; ++b) report = solve();
    samples.push_back((seconds() - start) / batch / cells * 1e6);
  }
  std::sort(samples.begin(), samples.end());
  std::printf("%-16s %4d x %4d x %3d  %8.4f us/cell (least %.4f)  %3d applications  residual %.1e%s\n", name,
              n[0], n[1], n[2], samples[samples.size() / 2], samples.front(), report.iterations,
              report.final / report.initial, report.converged ? "" : "  NOT CONVERGED");
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  const std::vector<std::array<int, 3>> sizes{{100, 80, 1}, {160, 48, 1}, {256, 128, 1}, {512, 256, 1},
                                              {32, 32, 32}, {64, 64, 64}, {96, 96, 96}};
  for (const auto& n : sizes) {
    for (const bool stiff : {false, true}) {
      Scalar s = stiff ? friction(n) : pressure(n);
      ScalarSolver solver(s.layout);
      measure(stiff ? "friction" : "pressure", n, repeats, [&] {
        std::fill(s.x.begin(), s.x.end(), 0.0);
        return solver.solve(s.faces, s.mass.data(), s.rhs.data(), s.x.data(), {0.0, 1e-6, 300});
      });
    }
  }
  for (const auto& n : std::vector<std::array<int, 3>>{{160, 48, 1},
                                                       {320, 96, 1},
                                                       {584, 175, 1},
                                                       {1168, 350, 1},
                                                       {20, 20, 20},
                                                       {40, 40, 40},
                                                       {80, 80, 80}}) {
    Coupled c(n);
    CoupledSolver solver(c.first.layout);
    Values x2(c.first.layout.size);
    for (const double relative : {1e-3, 1e-6})
      measure(relative > 1e-5 ? "coupled 1e-3" : "coupled 1e-6", n, repeats, [&] {
        std::fill(c.first.x.begin(), c.first.x.end(), 0.0);
        std::fill(x2.begin(), x2.end(), 0.0);
        return solver.solve(c.system, c.first.x.data(), x2.data(), {0.0, relative, 300});
      });
  }
  return 0;
}
