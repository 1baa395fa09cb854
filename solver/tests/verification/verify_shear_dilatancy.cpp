// Shear dilatancy in whole scenes: dense beds start at rest and suck when they shear, loose ones push.
#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

double base_pressure(const Simulation& run) {
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) sum += run.now.p_c[run.cell(i, 0)];
  return sum / 8.0;
}

// Whole scenes on coarse cells, the bed in whole cells: those filled in part are loose, and press on the
// pores.
std::vector<std::string> on_whole_cells(const std::string& more) {
  return {"grid.dx=0.005", "numerics.solid_flux=limited", "bed.length=0.095", "bed.height=0.05", more};
}

// The paper's dense column, 0.61, 50 ms behind its gate.
struct Rest {
  double pressure_change = 0.0;  // under the bed [Pa]
  double fastest = 0.0;          // grains in the bed [m/s]
};
Rest behind_the_gate(const std::string& more, const std::string& stiffness) {
  auto overrides = on_whole_cells(more);
  overrides.push_back(stiffness);
  overrides.emplace_back("time.hold=0.05");
  Simulation run(shipped_scene("s1-dense", overrides));
  const double start = base_pressure(run);
  Rest rest;
  run.until(-1e-3, [&] {
    const double change = base_pressure(run) - start;
    if (std::fabs(change) > std::fabs(rest.pressure_change)) rest.pressure_change = change;
    for (int j = 1; j < 9; ++j)
      for (int i = 1; i < 19; ++i)
        for (int d = 0; d < 2; ++d)
          rest.fastest = std::fmax(rest.fastest, std::fabs(run.now.u_s[d][run.cell(i, j)]));
  });
  report("pressure_change", rest.pressure_change);
  report("fastest", rest.fastest);
  return rest;
}

// By the elastic law (13) alone it springs apart; with a packing of its own it is at rest, whatever K.
TEST(ShearDilatancy, DenseBedStaysAtRest) {
  EXPECT_LT(behind_the_gate("model.shear_dilatancy=false", "contact.stiffness=1e8").pressure_change, -1e3);
  for (const char* stiffness : {"contact.stiffness=1e8", "contact.stiffness=1e7"}) {
    const Rest rest = behind_the_gate("model.shear_dilatancy=true", stiffness);
    EXPECT_NEAR(rest.pressure_change, 0.0, 0.1);
    EXPECT_LT(rest.fastest, 1e-5);
  }
}

// Least and largest change of the pore pressure under the column in the first 0.2 s of the collapse [Pa].
struct Extremes {
  double least = 0.0, largest = 0.0;
};
Extremes pressure_changes(const std::string& packing) {
  auto overrides = on_whole_cells("model.shear_dilatancy=true");
  overrides.push_back(packing);
  Simulation run(shipped_scene("s1", overrides));
  const double start = base_pressure(run);
  Extremes change;
  run.until(0.2, [&] {
    change.least = std::fmin(change.least, base_pressure(run) - start);
    change.largest = std::fmax(change.largest, base_pressure(run) - start);
  });
  return change;
}

TEST(ShearDilatancy, DenseSucksAndLoosePushes) {
  const Extremes dense = pressure_changes("bed.solid_fraction=0.61"),
                 loose = pressure_changes("bed.solid_fraction=0.572");
  for (const auto& [name, change] : {std::pair{"dense", dense}, std::pair{"loose", loose}}) {
    report(std::string(name) + "_least", change.least);
    report(std::string(name) + "_largest", change.largest);
  }
  EXPECT_LT(dense.least, -5.0);
  EXPECT_LT(dense.largest, 1.0);
  EXPECT_GT(loose.largest, 20.0);
}

// Where the front of a loose column of s1 is at the end, with steps up to dt_max [m].
double front_of_loose_column(const std::string& dt_max) {
  Simulation run(shipped_scene("s1", {"grid.dx=0.005", "model.preset=sourced", "time.end=5", dt_max}));
  run.until(run.scene.times.end);
  const auto dense = [&](int i) { return run.now.f_s[run.cell(i, 0)] > 0.95 * 0.57; };
  int i = 0;
  while (dense(i + 1)) ++i;
  const double inside = run.now.f_s[run.cell(i, 0)], outside = run.now.f_s[run.cell(i + 1, 0)];
  const double front = 0.005 * (i + 0.5 + (inside - 0.95 * 0.57) / (inside - outside));
  report("front with " + dt_max, front);
  return front;
}

// Its shear packs it within a step by more than its contacts take to bear it: of a pressure that met the
// packing of the step before, the run-out was 0.10 h0 farther.
TEST(ShearDilatancy, ALooseColumnRunsAsFarWithLongSteps) {
  EXPECT_NEAR(front_of_loose_column("numerics.dt_max=5e-3"), front_of_loose_column("numerics.dt_max=6e-4"),
              0.06 * 0.049);
}

}  // namespace
}  // namespace granvof::test
