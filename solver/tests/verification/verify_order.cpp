// Observed order of accuracy on smooth flows, and Galilean invariance.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/tests/verification/periodic_box.hpp"

namespace granvof::test {
namespace {

// Taylor & Green's decaying vortices, an exact solution of (5) without grains:
//   u = U sin(kx) cos(ky) exp(-2 nu k^2 t), v = -U cos(kx) sin(ky) exp(-2 nu k^2 t).
// Grids of 16, 32, 64 cells a side, steps with h^2 so that the first-order time step does not hide the order
// in space: 2 with limited fluxes (at least 1.8), 1 with upwind ones, from below (0.80, then 0.89 on these
// grids).
double taylor_green_error(int cells, const char* flux) {
  const double speed = 0.1, nu = 5e-5, end = 0.3;
  Simulation run(periodic_box(cells, 1e-3 * 32.0 * 32.0 / (cells * cells),
                              {std::string("numerics.solid_flux=") + flux, "bed.solid_fraction=1e-9"}));
  run.now.f_s.fill(0.0);
  const auto u = [&](double x, double y) { return speed * std::sin(wave * x) * std::cos(wave * y); };
  const auto v = [&](double x, double y) { return -speed * std::cos(wave * x) * std::sin(wave * y); };
  run.set_faces(run.now.u_c[0], 0, u);
  run.set_faces(run.now.u_c[1], 1, v);
  run.fill_ghosts();
  run.until(end);
  const double decay = std::exp(-2.0 * nu * wave * wave * end);
  double square = 0.0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const double h = run.grid.h[0];
      const double off = run.now.u_c[0][run.cell(i, j)] - decay * u(i * h, (j + 0.5) * h);
      square += off * off;
    }
  return std::sqrt(square) / cells / speed;
}

TEST(Order, TaylorGreen) {
  for (const char* flux : {"upwind", "limited"}) {
    const double coarse = taylor_green_error(16, flux), middle = taylor_green_error(32, flux),
                 fine = taylor_green_error(64, flux);
    const std::string name(flux);
    report("error_16_" + name, coarse);
    report("error_32_" + name, middle);
    report("error_64_" + name, fine);
    const double order = std::log2(middle / fine);
    report("order_" + name, order);
    if (name == "upwind") {
      EXPECT_GT(order, 0.8);
      EXPECT_LT(order, 1.1);
    } else {
      EXPECT_GT(order, 1.8);
    }
  }
}

// Both phases in smooth motion with drag: f_s = 0.3 + 0.1 cos(kx) cos(ky), grains crossing the liquid; no
// exact solution, the order is Richardson's from three grids: cell means on the coarsest grid.
void run_two_fluid(double drift, Simulation& run) {
  run.set(run.now.f_s,
          [](double x, double y) { return 0.3 + 0.1 * std::cos(wave * x) * std::cos(wave * y); });
  run.set_faces(run.now.u_s[0], 0,
                [=](double x, double y) { return drift + 0.1 * std::sin(wave * (x + y)); });
  run.set_faces(run.now.u_s[1], 1, [=](double x, double y) { return 0.1 * std::sin(wave * (x - y)); });
  run.set_faces(run.now.u_c[0], 0, [=](double, double y) { return drift + 0.1 * std::cos(wave * y); });
  run.set_faces(run.now.u_c[1], 1, [=](double x, double) { return 0.1 * std::cos(wave * x); });
  run.fill_ghosts();
  run.until(0.1);
}

// Means of blocks of `ratio` x `ratio` cells.
std::vector<double> coarsened(const Simulation& run, const Field& f, int cells) {
  const int ratio = run.grid.cells.n[0] / cells;
  std::vector<double> mean(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0);
  for (int j = 0; j < run.grid.cells.n[1]; ++j)
    for (int i = 0; i < run.grid.cells.n[0]; ++i) {
      const int block = j / ratio * cells + i / ratio;
      mean[static_cast<std::size_t>(block)] += f[run.cell(i, j)] / (ratio * ratio);
    }
  return mean;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

std::vector<double> two_fluid_means(int cells, const char* flux, double drift) {
  Simulation run(periodic_box(cells, 2e-3 * 16.0 * 16.0 / (cells * cells),
                              {std::string("numerics.solid_flux=") + flux}));
  run_two_fluid(drift, run);
  return coarsened(run, run.now.f_s, 16);
}

TEST(Order, TwoFluidDrift) {
  for (const char* flux : {"upwind", "limited"}) {
    const auto coarse = two_fluid_means(16, flux, 0.0), middle = two_fluid_means(32, flux, 0.0),
               fine = two_fluid_means(64, flux, 0.0);
    const double first = distance(coarse, middle), second = distance(middle, fine);
    const std::string name(flux);
    report("change_16_32_" + name, first);
    report("change_32_64_" + name, second);
    const double order = std::log2(first / second);
    report("order_" + name, order);
    if (name == "upwind") {
      EXPECT_GT(order, 0.6);
      EXPECT_LT(order, 1.1);
    } else {
      EXPECT_GT(order, 1.8);
    }
  }
}

// The same flow seen by an observer at 1 m/s, one period of the box later, is the same flow: the distance is
// the scheme's own error and falls with it.
TEST(Galilean, TwoFluidDrift) {
  for (const char* flux : {"upwind", "limited"}) {
    const double coarse = distance(two_fluid_means(16, flux, 1.0), two_fluid_means(16, flux, 0.0));
    const double middle = distance(two_fluid_means(32, flux, 1.0), two_fluid_means(32, flux, 0.0));
    const double fine = distance(two_fluid_means(64, flux, 1.0), two_fluid_means(64, flux, 0.0));
    const std::string name(flux);
    report("distance_16_" + name, coarse);
    report("distance_32_" + name, middle);
    report("distance_64_" + name, fine);
    const double order = std::log2(middle / fine);
    report("order_" + name, order);
    EXPECT_GT(order, name == "upwind" ? 0.5 : 1.5);
    EXPECT_LT(fine, name == "upwind" ? 0.02 : 0.002);  // of a variation of 0.1
  }
}

}  // namespace
}  // namespace granvof::test
