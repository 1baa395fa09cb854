// Granular temperature (7) and kinetic theory (11), (20)-(23) through the whole time step.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

// Grains alone: the fluid is light, inviscid (so that e = e0, (18)) and does not drag; no gravity.
std::string dry(double width, double height, double dx, const std::string& walls, double f_s, double e0,
                double diameter, double dt_max) {
  std::ostringstream text;
  text.precision(12);
  text << "[scene]\nname = \"dry\"\n[tank]\nsize = [" << width << ", " << height
       << "]\ngravity = 0\n[grid]\ndx = " << dx << "\n[walls]\n"
       << walls << "\n[gas]\ndensity = 1e-3\nviscosity = 0\n[solid]\ndensity = 1000\ndiameter = " << diameter
       << "\nrestitution = " << e0 << "\nfriction = 0\n[bed]\nlength = " << width << "\nheight = " << height
       << "\nsolid_fraction = " << f_s
       << "\n[model]\npreset = \"paper\"\ndrag = false\n[time]\nend = 1000\n[numerics]\n"
       << "volume_tolerance = 1e-9\ndt_max = " << dt_max << "\n";
  return text.str();
}

const char* const periodic_x = "left = \"periodic\"\nright = \"periodic\"\n";

// Haff, J. Fluid Mech. 134 (1983): homogeneous cooling. (7) without flow is 3/2 f_s rho_s dTheta/dt = -gamma,
// with gamma of (23) = G Theta^(3/2):
//   Theta = Theta_0 / (1 + t / t_c)^2,  t_c = 3 f_s rho_s / (G sqrt(Theta_0)).
// Box of 8 x 8 cells periodic both ways. Tolerance: implicit Euler, first order in dt: the distance at twice
// the step is twice as large, and 2 % at 50 steps a cooling time.
TEST(HomogeneousCooling, HaffsLaw) {
  const double f = 0.3, e = 0.9, d = 1e-3, theta0 = 1e-2, rho = 1000.0;
  const double g0 = (1.0 - 7.0 * f / 16.0) / std::pow(1.0 - f / 0.63, 2);
  const double gamma = 12.0 * (1.0 - e * e) * f * f * rho * g0 / (d * std::sqrt(std::numbers::pi));
  const double cooling = 3.0 * f * rho / (gamma * std::sqrt(theta0));
  std::array<double, 2> error{};
  for (int half = 0; half < 2; ++half) {
    Simulation run(parse_scene(
        dry(0.008, 0.008, 0.001, std::string(periodic_x) + "bottom = \"periodic\"\ntop = \"periodic\"\n", f,
            e, d, cooling / (half ? 100.0 : 50.0)),
        "haff"));
    run.now.theta.fill(theta0);
    run.fill_ghosts();
    run.until(4.0 * cooling);
    if (HasFatalFailure()) return;
    const double theory = theta0 / std::pow(1.0 + run.now.time / cooling, 2);
    const double* t = run.now.theta.data();
    const double most =
        max_over(run.grid.cells, run.grid.all_cells(), 0.0, [=](std::ptrdiff_t c) { return t[c]; });
    const double middle = run.now.theta[run.cell(3, 4)];
    error[static_cast<std::size_t>(half)] = middle / theory - 1.0;
    report(half ? "theta_half_step" : "theta", middle);
    report("theta_theory", theory);
    report(half ? "relative_error_half_step" : "relative_error", error[static_cast<std::size_t>(half)]);
    EXPECT_NEAR(most, middle, 1e-9 * middle);  // stays homogeneous
  }
  report("ratio_of_errors", error[0] / error[1]);
  EXPECT_LT(std::fabs(error[0]), 0.02);
  EXPECT_NEAR(error[0] / error[1], 2.0, 0.2);
}

// Steady simple shear between no-slip walls: f_s, Theta and shear are uniform, and production balances
// dissipation, f_s mu^K G^2 = gamma (corrections of (7); the printed factor 2 would give twice Theta):
//   Theta = d^2 G^2 / (15 (1 - e)),
// which with (15) is the dense-flow law 1/f_s = 1/f_s0 + a' I^delta, I = d G / sqrt(P / rho_s) (corrections
// of (15); with the printed lambda read as zeta - 2/3 mu, 9 (1 - e), P_s would be 9/15 of it). f_s = 0.568,
// where P^D > P^K and grains do not yet touch. Grid 4 x 16. Tolerance 0.5 %: the state is uniform, what is
// left is the approach to the steady state.
TEST(SimpleShear, SteadyBalance) {
  const double f = 0.568, e = 0.7, d = 1e-3, height = 0.016, speed = 0.16, rho = 1000.0;
  const double rate = 2.0 * speed / height;
  const std::string walls = std::string(periodic_x) +
                            "bottom.solid = \"no-slip\"\nbottom.velocity = [-0.16, 0]\n"
                            "top.solid = \"no-slip\"\ntop.velocity = [0.16, 0]\n";
  Simulation run(parse_scene(dry(0.004, height, 0.001, walls, f, e, d, 1e-3), "shear"));
  const double theory = d * d * rate * rate / (15.0 * (1.0 - e));
  run.set_faces(run.now.u_s[0], 0, [&](double, double y) { return rate * y - speed; });
  run.set_faces(run.now.u_c[0], 0, [&](double, double y) { return rate * y - speed; });
  run.set_faces(run.now.u_strain[0], 0, [&](double, double y) { return rate * y - speed; });
  run.now.theta.fill(0.3 * theory);
  run.fill_ghosts();
  run.until(1.0);
  if (HasFatalFailure()) return;
  const std::ptrdiff_t c = run.cell(1, 8);
  const double theta = run.now.theta[c], p = run.now.p_s[c];
  const double inertial = std::pow((1.0 / f - 1.0 / 0.60) / 0.28, 1.0 / 0.58);
  const double p_law = rho * d * d * rate * rate / (inertial * inertial);
  report("theta", theta);
  report("theta_over_corrected_balance", theta / theory);
  report("theta_over_printed_balance", theta / (2.0 * theory));
  report("P_s", p);
  report("P_s_over_dense_flow_law", p / p_law);
  report("P_s_over_law_with_9", p / (p_law * 9.0 / 15.0));
  report("shear_middle", (run.now.u_s[0][run.cell(1, 9)] - run.now.u_s[0][run.cell(1, 7)]) / (0.002 * rate));
  report("steps", static_cast<double>(run.steps));
  EXPECT_NEAR(theta, theory, 0.005 * theory);
  EXPECT_NEAR(p, p_law, 0.005 * p_law);
}

// Plane shear of frictionless spheres, e0 = 0.7, by DEM: Vescovi et al., Phys. Fluids 26, 053305 (2014).
// Walls at -U/2 and U/2, no gravity, periodic in x; mean f_s that of the published profile, which is the
// start. The gap is 18 diameters, as sedFoam's set-up of this flow has it; the walls are bumpy by glued
// spheres, here with psi = 36 degrees (the paper's smaller bumpiness, as remembered) and e_w = e0.
//
// The published profile is odd (u) and even (f_s, Theta) about the middle, and so is the one computed: the
// upper half of the gap, above a middle at rest. 2 x 18 cells, time means over t = 10 to 20 s, 550 to 1100
// shear units H / U. sedFoam asks for rms distances of 0.02 in f_s, 0.03 in u/U, 0.4 of the mean in Theta.
struct PlaneShear {
  double f_s = 0.0, u = 0.0, theta = 0.0;  // rms distances [-]
};

PlaneShear plane_shear(const std::vector<std::string>& choices, double gap_in_diameters,
                       const std::string& wall) {
  const double d = 1e-3, gap = gap_in_diameters * d, speed = 1.0, half = 0.5 * gap;
  const auto f_data = published("vescovi2014/solid_fraction.tsv");
  const auto u_data = published("vescovi2014/velocity.tsv");
  const auto theta_data = published("vescovi2014/granular_temperature.tsv");
  Curve f_profile;
  for (const auto& row : f_data) f_profile.add(row[1], row[0]);
  const auto start = [&](double y) { return 0.5 * (f_profile(0.5 + y / gap) + f_profile(0.5 - y / gap)); };
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) mean += start((i + 0.5) / 1000.0 * half) / 1000.0;
  const std::string walls = std::string(periodic_x) + "bottom.solid = \"no-slip\"\ntop = { fluid = " +
                            "\"no-slip\", velocity = [0.5, 0], " + wall + " }\n";
  std::vector<std::string> overrides{"grid.dy=0.0005"};
  overrides.insert(overrides.end(), choices.begin(), choices.end());
  Simulation run(parse_scene(dry(0.01, half, 0.005, walls, mean, 0.7, d, 1e-3), "shear", overrides));
  const int rows = run.grid.cells.n[1];
  run.set(run.now.f_s, [&](double, double y) { return start(y); });
  for (FaceField* u : {&run.now.u_s, &run.now.u_c, &run.now.u_strain})
    run.set_faces((*u)[0], 0, [&](double, double y) { return speed * y / gap; });
  run.now.theta.fill(1e-3);
  run.fill_ghosts();
  run.until(10.0);
  if (::testing::Test::HasFatalFailure()) return {};
  std::vector<std::array<double, 3>> sum(static_cast<std::size_t>(rows));
  const double begin = run.now.time;
  double last = begin;
  run.until(20.0, [&] {
    const double dt = run.now.time - last;
    last = run.now.time;
    for (int j = 0; j < rows; ++j) {
      auto& row = sum[static_cast<std::size_t>(j)];
      const std::ptrdiff_t c = run.cell(0, j);
      row[0] += dt * run.now.f_s[c];
      row[1] += dt * run.now.u_s[0][c] / speed;
      row[2] += dt * run.now.theta[c] / (speed * speed);
    }
  });
  if (::testing::Test::HasFatalFailure()) return {};
  Curve f, u, theta;  // over the whole gap
  for (int j = -rows; j < rows; ++j) {
    const double y = 0.5 + 0.5 * (j + 0.5) / rows;
    const auto& row = sum[static_cast<std::size_t>(j < 0 ? -j - 1 : j)];
    f.add(y, row[0] / (last - begin));
    u.add(y, 0.5 + (j < 0 ? -row[1] : row[1]) / (last - begin));
    theta.add(y, row[2] / (last - begin));
    if (j >= 0 && (j % 4 == 1 || j == rows - 1))
      std::printf("    y/H %.3f f_s %.3f (%.3f) u/U %.3f Theta/U2 %.2e\n", y, f(y), f_profile(y), u(y),
                  theta(y));
  }
  const auto rms = [](const std::vector<std::vector<double>>& data, const Curve& curve) {
    double square = 0.0;
    for (const auto& row : data) square += std::pow(curve(row[1]) - row[0], 2);
    return std::sqrt(square / static_cast<double>(data.size()));
  };
  double theta_mean = 0.0;
  for (const auto& row : theta_data) theta_mean += row[0] / static_cast<double>(theta_data.size());
  const PlaneShear off{rms(f_data, f), rms(u_data, u), rms(theta_data, theta) / theta_mean};
  report("rms_f_s", off.f_s);
  report("rms_u_over_U", off.u);
  report("rms_theta_over_mean", off.theta);
  report("f_s_middle", f(0.5));
  report("f_s_wall", f(1.0));
  report("theta_middle", theta(0.5));
  report("theta_wall", theta(1.0));
  report("steps", static_cast<double>(run.steps));
  return off;
}

const std::vector<std::string> dense_collisions{
    "model.radial_distribution=jamming", "model.correlated_collisions=true",
    // smooth spheres touch nowhere below where they jam, and have no (15)
    "contact.solid_fraction_max=0.636", "contact.solid_fraction_min=0.63", "model.dilatancy_pressure=false"};
const std::string glued_spheres = "solid = \"bumpy\", bumpiness = 36";

// Met in f_s (0.014) and u (0.015). Theta is missed by name, 0.68 for 0.4: at the wall it is 0.0025 of their
// 0.0042, which is the loss to the bumps: with e_w = 0.85 it is 0.0053, and the rms 0.46. What each part is
// worth stands in docs/theory/choices.md; the paper's laws and no-slip walls leave 0.091, 0.124, 2.8 (20
// diameters). Red if Theta gets worse, and if it is met.
TEST(PlaneShear, ProfilesOfVescoviEtAl) {
  const PlaneShear off = plane_shear(dense_collisions, 18.0, glued_spheres);
  EXPECT_LT(off.f_s, 0.020);
  EXPECT_LT(off.u, 0.030);
  EXPECT_GT(off.theta, 0.40);
  EXPECT_LT(off.theta, 0.75);
}

// A dry column on cells of 0.8 and 0.4 grain diameters falls: Theta gains what the kinetic stress loses. What
// the lag between the two makes or takes stays below 1 % of what collisions dissipate (measured 0.06 and 0.15
// %; collisions dissipate 0.60 and 0.58 of the fall). With the production at the new strain it was 64 and 107
// %, and collisions dissipated 1.3 and 127 times the fall.
TEST(DryCollapse, FluctuationEnergyIsThatOfTheStress) {
  for (const double dx : {0.8 * 0.8e-3, 0.4 * 0.8e-3}) {
    const std::string text = fmt::format(
        "[scene]\nname = \"dry\"\n[tank]\nsize = [0.0512, 0.0128]\n[grid]\ndx = {}\n[walls]\nall = "
        "\"no-slip\"\ntop = \"open\"\n[gas]\ndensity = 1\nviscosity = 1e-5\n[solid]\ndensity = 2500\n"
        "diameter = 0.8e-3\nrestitution = 0.9\nfriction = 0.4\n[bed]\nlength = 0.0128\nheight = 0.0096\n"
        "solid_fraction = 0.57\n[model]\npreset = \"paper\"\n[time]\nend = 1\n[numerics]\nsolid_flux = "
        "\"limited\"\n",
        dx);
    Simulation run(parse_scene(text, "dry"));
    const double height = run.now.energy.potential;
    run.until(0.08);
    if (HasFatalFailure()) return;
    const EnergyTerms& energy = run.now.energy;
    report(fmt::format("numerical_over_collisions_{:.2f}", dx / 0.8e-3),
           energy.numerical_granular / energy.collisions);
    report("collisions_over_fall", energy.collisions / (height - energy.potential));
    EXPECT_LT(std::fabs(energy.numerical_granular), 0.01 * energy.collisions);
  }
}

}  // namespace
}  // namespace granvof::test
