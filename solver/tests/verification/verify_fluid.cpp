// Gas and liquid without grains.
#include <cmath>
#include <numbers>

#include "solver/output/extract_liquid.hpp"
#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

// Front of a collapsing square column of water, x/a against tau = t sqrt(2 g / a), Martin & Moyce, Phil.
// Trans. R. Soc. A 244 (1952), cases/dam-break.toml (160 x 40 cells, a/32).
struct FrontDistance {
  double rms = 0.0, most = 0.0;  // in x/a, over the published range, clocks as published
  double speed = 0.0;            // of the front over tau = 1.82 to 2.96 [a / tau]; no clock enters
  double published_speed = 0.0;
  double rms_shifted = 0.0;  // published tau less 0.175, as others compare it
};

FrontDistance dam_break(const std::vector<std::string>& overrides) {
  Simulation run(shipped_scene("dam-break", overrides));
  const double a = run.scene.liquid_boxes[0].upper[0];
  const double unit = std::sqrt(a / (2.0 * run.scene.gravity));
  Curve front, measured;
  front.add(0.0, 1.0);
  run.until(3.0 * unit, [&] {
    if (const Value x = scalar::liquid_front(cell_fields(run.grid, run.now), run.scene))
      front.add(run.now.time / unit, *x / a);
  });
  FrontDistance d;
  double points = 0.0;
  for (const auto& row : published("martin_moyce_1952.tsv")) {
    measured.add(row[0], row[1]);
    const double off = front(row[0]) - row[1], shifted = front(row[0] - 0.175) - row[1];
    d.rms += off * off;
    d.rms_shifted += shifted * shifted;
    d.most = std::fmax(d.most, std::fabs(off));
    points += 1.0;
  }
  d.rms = std::sqrt(d.rms / points);
  d.rms_shifted = std::sqrt(d.rms_shifted / points);
  d.speed = (front(2.96) - front(1.82)) / (2.96 - 1.82);
  d.published_speed = (measured(2.96) - measured(1.82)) / (2.96 - 1.82);
  report("steps", run.steps);
  report("rms", d.rms);
  report("max", d.most);
  report("rms_clock_shifted_0.175", d.rms_shifted);
  report("front_speed", d.speed);
  report("front_speed_published", d.published_speed);
  return d;
}

// With the published clock shifted by 0.175, as others do, half of that uncertainty at the late front speed
// of 1.37 is left: rms 0.12 in x/a. The late front speed, which needs no clock, is a named expected failure:
// 10 % is asked for, 12 % missing (upwind: 29 %). Red if that gets worse, and if it is mended. The case is as
// shipped, with second-order momentum.
TEST(DamBreak, FrontWithLimitedMomentum) {
  const FrontDistance d = dam_break({});
  EXPECT_LT(d.rms_shifted, 0.12);
  EXPECT_GT(d.speed / d.published_speed, 0.85);
  EXPECT_LT(d.speed / d.published_speed, 0.90);
}

// Expected failure. First-order upwind momentum drags the thin tongue of water towards the still gas above
// it: the late front is about 29 % too slow, on a/16 as on a/32 cells and at a quarter of the time step. The
// test turns red if that gets worse, and if it is mended.
TEST(DamBreak, FrontWithFirstOrderMomentumLags) {
  const FrontDistance d = dam_break({"numerics.solid_flux=upwind"});
  EXPECT_GT(d.most, 0.33);
  EXPECT_LT(d.most, 0.45);
  EXPECT_GT(d.speed / d.published_speed, 0.66);
  EXPECT_LT(d.speed / d.published_speed, 0.76);
}

// Standing wave of two layers in a closed tank, Lamb, Hydrodynamics, art. 231:
//   omega^2 = g k (rho_l - rho_g) / (rho_l coth(k h_l) + rho_g coth(k h_g)), k = pi / L.
// Slip walls, 40 x 40 cells, amplitude 2 mm (one cell, k a = 0.06: its finite-amplitude shift is 0.1 %), four
// periods, steps of a 190th of one (first order in time). Tolerance 1 % in the frequency, 10 % in the
// amplitude after three periods (viscosity damps 1 %).
TEST(Sloshing, FirstMode) {
  Simulation run(parse_scene(R"(
[scene]
name = "sloshing"
[tank]
size = [0.1, 0.1]
[grid]
dx = 0.0025
[walls]
all = "slip"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.05
[model]
preset = "paper"
[time]
end = 1.5
[numerics]
dt_max = 0.002
)",
                             "sloshing"));
  const double k = std::numbers::pi / 0.1, level = 0.05, amplitude = 0.002, g = run.scene.gravity;
  const double h = run.grid.h[1];
  run.set(run.now.alpha, [&](double x, double y) {
    return std::clamp((level + amplitude * std::cos(k * x) - y) / h + 0.5, 0.0, 1.0);
  });
  run.fill_ghosts();
  Curve mode;
  const auto observe = [&] {
    double sum = 0.0;
    for (int j = 0; j < run.grid.cells.n[1]; ++j)
      for (int i = 0; i < run.grid.cells.n[0]; ++i)
        sum += run.now.alpha[run.cell(i, j)] * std::cos(k * (i + 0.5) * run.grid.h[0]);
    mode.add(run.now.time, sum * h * 2.0 / run.grid.cells.n[0]);
  };
  observe();
  run.until(1.5, observe);
  const double coth = 1.0 / std::tanh(k * level);
  const double omega = std::sqrt(g * k * 999.0 / (1000.0 * coth + coth));
  const auto zeros = mode.zeros();
  ASSERT_EQ(zeros.size(), 8u);
  const double measured = std::numbers::pi * 7.0 / (zeros.back() - zeros.front());
  double last = 0.0;
  for (std::size_t i = 0; i < mode.x.size(); ++i)
    if (mode.x[i] > 1.1) last = std::fmax(last, std::fabs(mode.y[i]));
  report("omega", measured);
  report("omega_theory", omega);
  report("relative_error", measured / omega - 1.0);
  report("amplitude_left", last / amplitude);
  report("steps", run.steps);
  EXPECT_NEAR(measured, omega, 0.01 * omega);
  EXPECT_NEAR(last, amplitude, 0.1 * amplitude);
}

// Still water under still gas, 1000 : 1, the surface inside a row of cells (cases/pool.toml, 80 x 40 cells, 2
// s): hydrostatics balance face by face, so that rounding alone is left; 1e-10 m/s is far above it and far
// below anything that matters.
TEST(Pool, SpuriousVelocity) {
  Simulation run(shipped_scene("pool"));
  double most = 0.0;
  run.until(2.0, [&] { most = std::fmax(most, run.fastest(run.now.u_c)); });
  report("largest_speed", most);
  report("steps", run.steps);
  EXPECT_LT(most, 1e-10);
}

}  // namespace
}  // namespace granvof::test
