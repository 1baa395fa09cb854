// Drag, eqs (8) and (9), through the whole time step: settling and flow through a packed bed.
#include <cmath>

#include "solver/closures/drag/drag.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

struct Beads {
  const char* name;
  double diameter, density, liquid_density, liquid_viscosity;
};

void PrintTo(const Beads& b, std::ostream* out) {
  *out << b.name;
}

// Eqs (8), (9) as printed, with Re = rho |w| d / mu and the Wen & Yu branch through C_D itself; the blend
// over f_c in [0.78, 0.82] is the code's (correction of (8)).
double printed_drag(double f_s, double w, const Beads& b) {
  const double f_c = 1.0 - f_s, d = b.diameter, rho = b.liquid_density, mu = b.liquid_viscosity;
  const double re = rho * w * d / mu;
  const double c_d = 0.4 + 24.0 / re + 6.0 / (1.0 + std::sqrt(re));
  const double wen_yu = 0.75 * c_d * f_s * rho * w / d * std::pow(f_c, -1.65);
  const double ergun = 150.0 * f_s * f_s * mu / (f_c * d * d) + 1.75 * f_s * rho * w / d;
  if (f_c >= 0.82) return wen_yu;
  if (f_c <= 0.78) return ergun;
  return ((f_c - 0.78) * wen_yu + (0.82 - f_c) * ergun) / 0.04;
}

// Slip of a uniform suspension that settles without acceleration, no net flow: f_c (6) - f_s (5) is
//   beta w = f_s f_c (rho_s - rho_c) g.
double terminal_slip(double f_s, const Beads& b, double gravity) {
  const double weight = f_s * (1.0 - f_s) * (b.density - b.liquid_density) * gravity;
  double low = 1e-9, high = 10.0;
  for (int i = 0; i < 200; ++i) {
    const double w = 0.5 * (low + high);
    (printed_drag(f_s, w, b) * w < weight ? low : high) = w;
  }
  return low;
}

// A closed column of liquid with slip walls, 4 x 80 cells, filled with a suspension of f_s. The tolerance on
// volumes is tightened: 1e-6 of a cell a step shows in the slip of a dilute suspension (0.1 %).
Scene column(double f_s, const Beads& b, double height, double dt_max) {
  std::ostringstream text;
  text.precision(12);
  text << "[scene]\nname = \"column\"\n[tank]\nsize = [" << height / 20.0 << ", " << height
       << "]\n[grid]\ndx = " << height / 80.0
       << "\n[walls]\nall = \"slip\"\n[gas]\ndensity = 1\nviscosity = 1e-5\n[liquid]\ndensity = "
       << b.liquid_density << "\nviscosity = " << b.liquid_viscosity << "\nlevel = " << height
       << "\n[solid]\ndensity = " << b.density << "\ndiameter = " << b.diameter
       << "\nfriction = 0.4\n[bed]\nlength = " << height / 20.0 << "\nheight = " << height
       << "\nsolid_fraction = " << f_s
       << "\n[model]\npreset = \"paper\"\n[time]\nend = 100\n[numerics]\nvolume_tolerance = 1e-10\n"
       << "dt_max = " << dt_max << "\n";
  return parse_scene(text.str(), "column");
}

// Slip in the middle of a settling column against terminal_slip(). The scheme has no spatial error in a
// uniform suspension and is at its steady state after 20 relaxation times, so that 1e-3 leaves room for the
// approach alone. To that comes what the friction solver leaves: 1e-7 m/s a step, five times that at steps of
// a fifth of the relaxation time. The column is so high that neither front reaches its middle.
class Settling : public ::testing::TestWithParam<Beads> {
 protected:
  void check(double f_s) {
    const Beads& b = GetParam();
    const double solver_leaves = 5.0 * 1e-7;
    const double slip = terminal_slip(f_s, b, 9.81);
    const double relaxation = slip / (9.81 * (1.0 - b.liquid_density / b.density));
    const double duration = 20.0 * relaxation;
    Simulation run(column(f_s, b, std::fmax(0.08, 4.0 * slip * duration), 0.2 * relaxation));
    run.until(duration);
    if (HasFatalFailure()) return;
    const std::ptrdiff_t middle = run.cell(2, 40);
    const double measured = run.now.u_c[1][middle] - run.now.u_s[1][middle];
    report("reynolds", b.liquid_density * slip * b.diameter / b.liquid_viscosity);
    report("slip", measured);
    report("slip_theory", slip);
    report("relative_error", measured / slip - 1.0);
    report("steps", run.steps);
    report("solver_leaves", solver_leaves / slip);
    EXPECT_NEAR(measured, slip, 1e-3 * slip + solver_leaves);
  }
};

TEST_P(Settling, SingleGrain) {
  check(1e-3);
}
TEST_P(Settling, Hindered010) {
  check(0.1);
}
TEST_P(Settling, Hindered020) {
  check(0.2);
}
TEST_P(Settling, Hindered030) {
  check(0.3);
}
TEST_P(Settling, Hindered040) {
  check(0.4);
}

std::string name_of(const ::testing::TestParamInfo<Beads>& beads) {
  return beads.param.name;
}

INSTANTIATE_TEST_SUITE_P(Beads, Settling,
                         ::testing::Values(Beads{"fine", 0.29e-3, 1050, 950, 0.004},
                                           Beads{"glass", 0.8e-3, 2500, 1000, 1e-3},
                                           Beads{"coarse", 3.2e-3, 2500, 1000, 1e-3}),
                         name_of);

// Pressure gradient along a packed bed, lower branch of (8) (Ergun): grains too heavy to move, no gravity, a
// loop (periodic in x) half of which is bed; fluid momentum (5) inside the bed reads
//   -f_c dP/dx = beta u + f_c rho_c du/dt,
// where u decays as the loop has no pump. 80 x 4 cells, steps of 1e-6 s (a hundredth of the decay time, as
// beta is of the old level): 1 %.
// The laws beside the paper's, made for grains in suspension or at random, are within a quarter of Ergun.
struct Flow {
  double speed;  // superficial [m/s]
  const char* law;
};

void PrintTo(const Flow& f, std::ostream* out) {
  *out << f.speed << " m/s, " << f.law;
}

class PackedBed : public ::testing::TestWithParam<Flow> {};

TEST_P(PackedBed, PressureDrop) {
  const double speed = GetParam().speed, f_s = 0.55;
  const std::vector<std::string> law{std::string("model.drag_law=") + GetParam().law};
  const Beads b{"bed", 0.8e-3, 1e9, 1000, 1e-3};
  Simulation run(parse_scene(R"(
[scene]
name = "loop"
[tank]
size = [0.08, 0.004]
gravity = 0
[grid]
dx = 0.001
[walls]
left = "periodic"
right = "periodic"
all = "slip"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.004
[solid]
density = 1e9
diameter = 0.8e-3
friction = 0.4
[bed]
x = 0.02
length = 0.04
height = 0.004
solid_fraction = 0.55
[model]
preset = "paper"
[time]
end = 1
[numerics]
dt_max = 1e-6
volume_tolerance = 1e-12
)",
                             "loop", law));
  run.set_faces(run.now.u_c[0], 0, [&](double x, double) {
    const double f = x > 0.0205 && x < 0.0595 ? f_s : (x < 0.0195 || x > 0.0605 ? 0.0 : 0.5 * f_s);
    return speed / (1.0 - f);
  });
  run.fill_ghosts();
  double least = 1e9, most = -1e9;
  for (int step = 0; step < 200; ++step) {
    run.advance(1e-6);
    if (HasFatalFailure()) return;
  }
  const double u_before = run.now.u_c[0][run.cell(40, 2)], t_before = run.now.time;
  run.advance(1e-6);
  if (HasFatalFailure()) return;
  const double u = run.now.u_c[0][run.cell(40, 2)];
  const double rate = (u - u_before) / (run.now.time - t_before);
  for (int i = 25; i < 55; ++i) {
    const double gradient = (run.now.p_c[run.cell(i, 2)] - run.now.p_c[run.cell(i - 1, 2)]) / run.grid.h[0];
    least = std::fmin(least, gradient);
    most = std::fmax(most, gradient);
  }
  const double ergun = printed_drag(f_s, u, b);
  const double drag = run.scene.model.drag_law.with(
      [&](auto named) { return named(f_s, u, run.scene.liquid, run.scene.solid.diameter); });
  if (run.scene.model.drag_law == DragLaw::of<closures::DragPaper>()) {
    EXPECT_NEAR(drag, ergun, 1e-12 * ergun);
  }
  const double theory = -drag * u / (1.0 - f_s) - 1000.0 * rate;
  report("superficial_speed", u * (1.0 - f_s));
  report("reynolds", 1000.0 * u * b.diameter / 1e-3);
  report("gradient_least", least);
  report("gradient_most", most);
  report("gradient_theory", theory);
  report("inertia_to_drag", 1000.0 * rate * (1.0 - f_s) / (drag * u));
  report("drag_to_ergun", drag / ergun);
  EXPECT_NEAR(drag, ergun, 0.25 * ergun);
  report("relative_error", 0.5 * (least + most) / theory - 1.0);
  EXPECT_NEAR(least, theory, 0.01 * std::fabs(theory));
  EXPECT_NEAR(most, theory, 0.01 * std::fabs(theory));
}

INSTANTIATE_TEST_SUITE_P(Speeds, PackedBed,
                         ::testing::Values(Flow{1e-4, "paper"}, Flow{5e-3, "paper"}, Flow{0.1, "paper"},
                                           Flow{5e-3, "di-felice"}, Flow{5e-3, "beetstra"},
                                           Flow{5e-3, "tenneti"}));

}  // namespace
}  // namespace granvof::test
