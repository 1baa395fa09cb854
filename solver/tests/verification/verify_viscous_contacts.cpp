// Grains in a viscous liquid: a layer that is tilted starts late where it is dense, at once where it is
// loose.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

// Pailha, Nicolas and Pouliquen, Phys. Fluids 20, 111701 (2008): glass beads of 160 um, rho_s 2500, in a
// liquid of rho 1041 and 0.096 Pa s; a layer of 4.9 mm at rest at a packing of 0.584 or 0.571, then at 25
// degrees. Friction as sedFoam's set-up of this layer has it, mu(I_v) of 0.425, 0.765, 0.004; K_psi and f_c
// measured on the same beads (Pailha and Pouliquen 2009), the defaults. Their liquid is at rest along the
// slope: of gravity there only the submerged part of the beads moves anything.
constexpr double layer = 4.9e-3, slope = 25.0 * std::numbers::pi / 180.0;
constexpr int rows_of_layer = 14;
constexpr double height = layer / rows_of_layer, rho_l = 1041.0, rho_s = 2500.0;

std::string tilted_layer(double packing) {
  return fmt::format(
      "[scene]\nname = \"layer\"\n[tank]\nsize = [{0}, {1}]\ngravity = {2}\n[grid]\ndx = {3}\n[walls]\n"
      "left = \"periodic\"\nright = \"periodic\"\nbottom = \"no-slip\"\ntop = \"slip\"\n"
      "[gas]\ndensity = 1\nviscosity = 1e-5\n[liquid]\ndensity = {4}\nviscosity = 0.096\nlevel = {1}\n"
      "[solid]\ndensity = {5}\ndiameter = 160e-6\nfriction = 0.425\n"
      "[contact]\nfast_friction = 0.765\nviscous_number = 0.004\nsolid_fraction_min = 0.54\n"
      "[bed]\nlength = {0}\nheight = {6}\nsolid_fraction = {7}\n"
      "[model]\npreset = \"advised\"\ngranular_temperature = \"off\"\nles = false\n"
      "friction_law = \"viscous\"\nshear_dilatancy = true\ncritical_packing = \"by-rate\"\n"
      "viscous_contact_pressure = true\nsuspension_viscosity = true\ndilatancy_friction = false\n"
      "[time]\nend = 1000\n[numerics]\ndt_max = 0.05\n",
      2.0 * height, 2.0 * layer, 9.81 * std::cos(slope), height, rho_l, rho_s, layer, packing);
}

struct Start {
  Curve speed;     // of the layer's surface [mm/s] against time [s]
  Curve pressure;  // excess at the base [Pa]
};

Start start_of(double packing, double until, const std::vector<std::string>& overrides = {}) {
  Simulation run(parse_scene(tilted_layer(packing), "layer", overrides));
  run.extra.emplace(BodyAcceleration{FaceField(run.grid), FaceField(run.grid)});
  const double pull = (1.0 - rho_l / rho_s) * 9.81 * std::sin(slope);
  run.set_faces(run.extra->solid[0], 0, [=](double, double) { return pull; });
  const auto base_over_top = [&] {
    return run.now.p_c[run.cell(0, 0)] - run.now.p_c[run.cell(0, 2 * rows_of_layer - 1)];
  };
  const double still = base_over_top();
  Start start;
  double next = 0.0;
  run.until(until, [&] {
    if (run.now.time < next) return;
    next += 0.5;
    start.speed.add(run.now.time, 1e3 * run.now.u_s[0][run.cell(0, rows_of_layer - 1)]);
    start.pressure.add(run.now.time, base_over_top() - still);
  });
  report(fmt::format("steps_{}", packing), static_cast<double>(run.steps));
  return start;
}

Curve measured(const std::string& name) {
  Curve curve;
  for (const auto& row : published("pailha2008/" + name + ".tsv")) curve.add(row[0], row[1]);
  return curve;
}

// When the surface first moves at half of its last speed [s].
double delay(const Curve& speed) {
  const double half = 0.5 * speed.y.back();
  for (std::size_t i = 1; i < speed.x.size(); ++i)
    if (speed.y[i - 1] < half && speed.y[i] >= half) return speed.x[i];
  return 0.0;
}

double mean(const Curve& curve, double from, double to) {
  double sum = 0.0;
  constexpr int pieces = 200;
  for (int i = 0; i < pieces; ++i) sum += curve(from + (i + 0.5) / pieces * (to - from)) / pieces;
  return sum;
}

// Dense: it sucks at its pores, creeps, and speeds up over minutes as it dilates. Goals are 30 % in delay,
// sign and size of the pressure, met with steps of 12.5 ms: half of the last speed is there after 196 s of
// 200, that speed is 0.90 of theirs, the largest suction from 10 s on -2.8 of -3.4 Pa. The delay is a matter
// of the step: 95, 110, 136, 212 s with 200, 100, 50, 25 ms. By name not met: the suction fades too soon (its
// mean from 40 to 160 s is 0.61 of theirs), and their first reading, -2.2 Pa after 0.6 s, is -3.8 here. Red
// if either gets worse, and if it is met.
TEST(TiltedLayer, DenseStartsLateAndSucks) {
  const Start start = start_of(0.584, 520.0, {"numerics.dt_max=0.0125"});
  if (HasFatalFailure()) return;
  const Curve speed = measured("speed_584"), pressure = measured("pressure_584");
  double suction = 0.0;
  for (std::size_t i = 0; i < start.pressure.x.size(); ++i)
    if (start.pressure.x[i] > 10.0) suction = std::min(suction, start.pressure.y[i]);
  const double theirs = std::ranges::min(pressure.y);
  const double first = start.pressure(pressure.x.front()) / pressure.y.front();
  const double later = mean(start.pressure, 40.0, 160.0) / mean(pressure, 40.0, 160.0);
  const double late = delay(start.speed) / delay(speed), fast = start.speed.y.back() / speed.y.back();
  report("largest_suction", suction);
  report("largest_suction_measured", theirs);
  report("mean_suction_over_measured", later);
  report("first_suction_over_measured", first);
  report("delay", delay(start.speed));
  report("delay_over_measured", late);
  report("last_speed_over_measured", fast);
  EXPECT_NEAR(suction, theirs, 0.3 * std::fabs(theirs));
  EXPECT_LT(mean(start.pressure, 10.0, 300.0), 0.0);
  EXPECT_LT(start.speed(20.0), 0.25 * start.speed.y.back());
  EXPECT_NEAR(late, 1.0, 0.3);
  EXPECT_NEAR(fast, 1.0, 0.3);
  EXPECT_LT(later, 0.7);
  EXPECT_GT(later, 0.55);
  EXPECT_GT(first, 1.3);
  EXPECT_LT(first, 2.0);
}

// Loose: it pushes at its pores and runs at once. Sign, size and speed are met for the first 20 s; theirs
// then turn to a suction of 0.3 to 1.1 Pa, which is not in the model.
TEST(TiltedLayer, LooseRunsAtOnceAndPushes) {
  const Start start = start_of(0.571, 20.0, {"numerics.dt_max=0.02"});
  if (HasFatalFailure()) return;
  const Curve speed = measured("speed_571"), pressure = measured("pressure_571");
  const double ours = mean(start.pressure, 3.0, 20.0), theirs = mean(pressure, 3.0, 20.0);
  report("mean_pressure", ours);
  report("mean_pressure_measured", theirs);
  report("speed", start.speed(20.0));
  report("last_speed_measured", speed.y.back());
  report("delay", delay(start.speed));
  report("delay_measured", delay(speed));
  EXPECT_NEAR(ours, theirs, 0.3 * theirs);
  EXPECT_NEAR(start.speed(20.0), speed.y.back(), 0.3 * speed.y.back());
  EXPECT_LT(delay(start.speed), delay(speed));
}

// The same layer with the paper's contacts, which touch at 0.54 whatever was prepared: it springs apart.
TEST(TiltedLayer, WithoutAPackingOfItsOwnTheDenseOneSpringsApart) {
  const Start start =
      start_of(0.584, 2.0, {"model.shear_dilatancy=false", "model.packing=uniform", "numerics.dt_max=0.02"});
  if (HasFatalFailure()) return;
  const double least = std::ranges::min(start.pressure.y);
  report("least_pressure", least);
  EXPECT_LT(least, -100.0);
}

}  // namespace
}  // namespace granvof::test
