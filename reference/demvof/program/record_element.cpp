#include "reference/demvof/program/record_element.hpp"

#include <fmt/format.h>

#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/element/cooling.hpp"
#include "reference/demvof/element/first_flow.hpp"
#include "reference/demvof/element/material.hpp"
#include "reference/demvof/element/wall_friction.hpp"
#include "reference/demvof/program/test_directory.hpp"
#include "solver/output/atomic_file.hpp"

namespace demvof {

namespace {

constexpr int repeats_at_rest = 3;   // seeds of each packing
constexpr int repeats_of_first = 2;  // seeds of first strain

void say(const RecordOptions& options, const std::string& what) {
  if (options.progress) fmt::print(stderr, "demvof: {}\n", what);
}

ElementTests tests_of(const granvof::Scene& scene, const RecordOptions& options, const std::string& scratch) {
  ChuteSettings settings = chute_settings(scene, options.seed, scratch);
  settings.find_start = true;
  ElementTests tests;
  say(options, "packing at rest");
  ContactLaw rough = settings.law, smooth = settings.law;
  rough.bead_friction = scene.reference->preparation_friction;
  rough.rolling_friction = scene.reference->preparation_rolling_friction;
  smooth.bead_friction = 0.0;
  tests.loosest = packing_at_rest(settings, rough, repeats_at_rest);
  tests.densest = packing_at_rest(settings, smooth, repeats_at_rest);
  say(options, "restitution");
  tests.restitution = cooling_restitution(settings);
  if (settings.law.wall_friction > 0.0) {
    say(options, "friction on a wall");
    tests.wall = wall_friction(settings);
  }
  say(options, "friction of first strain");
  for (int repeat = 0; repeat < repeats_of_first; ++repeat) {
    LayerSettings seeded = settings;
    seeded.seed += static_cast<unsigned>(repeat);
    tests.first.push_back(first_flow(seeded, rough));
  }
  say(options, "friction on a chute");
  tests.chute = run_chute(settings);
  tests.friction = fit_of(tests.chute);
  tests.first_friction = fit_of_first(tests.first, tests.chute);
  tests.critical = critical_packing(tests.chute, tests.critical_load);
  return tests;
}

Monitors monitors_of(const granvof::Scene& scene, const ElementTests& tests) {
  Monitors monitors = friction_monitors(tests.chute, tests.friction);
  const auto add = [&](const std::string& name, const Measured& measured) {
    monitors[name] = measured.value;
    monitors[name + "_band"] = measured.band;
  };
  add("loosest_packing", tests.loosest.solid_fraction);
  add("densest_packing", tests.densest.solid_fraction);
  add("critical_packing", tests.critical);
  add("cooling_restitution", tests.restitution);
  if (tests.wall) add("plane_wall_friction", *tests.wall);
  add("first_mu_s", {tests.first_friction.law.at_rest, tests.first_friction.band.at_rest});
  add("first_mu_2", {tests.first_friction.law.limit, tests.first_friction.band.limit});
  add("first_I_0", {tests.first_friction.law.scale, tests.first_friction.band.scale});
  monitors["first_fit_rms"] = tests.first_friction.rms;
  std::vector<double> starts;
  for (const FirstFlow& flow : tests.first)
    if (flow.started_at) starts.push_back(*flow.started_at);
  if (starts.size() > 1) add("first_start_deg", mean_of(starts));
  monitors["loosest_load_Pa"] = tests.loosest.load;
  monitors["critical_load_Pa"] = tests.critical_load;
  monitors["touching_loosest"] =
      touching_fraction(scene.contact, tests.loosest.solid_fraction.value, tests.loosest.load);
  monitors["touching_critical"] = touching_fraction(scene.contact, tests.critical.value, tests.critical_load);
  return monitors;
}

int record_in_this_process(const granvof::Scene& scene, const RecordOptions& options,
                           const std::filesystem::path& scratch) {
  const MpiSession session;
  const TestClock clock;
  const ElementTests tests = tests_of(scene, options, scratch.string());
  const std::string material = material_text(scene, tests);
  write_tests(scene, options, clock, tests.chute, monitors_of(scene, tests));
  granvof::write_file_atomically(options.out / "material.toml", material);
  fmt::print("{}", material);
  return 0;
}

}  // namespace

int record_element(const granvof::Scene& scene, const RecordOptions& options) {
  return record_tests(scene, options, "touching_loosest", record_in_this_process);
}

}  // namespace demvof
