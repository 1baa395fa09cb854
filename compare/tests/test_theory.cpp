// Reference values from theory, against numbers worked out by hand from the shipped scenes.
#include <string>

#include <gtest/gtest.h>

#include "compare/checks/theory.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

double value_of(const char* formula, const char* scene) {
  Run run;
  run.scene = load_scene(cases_directory() / (std::string(scene) + ".toml"), {});
  const FormulaEntry* entry = find_formula(formula);
  return entry == nullptr ? -1.0 : entry->function(run, {}).value_or(-1.0);
}

// Mean speed 0.02 m/s between plates.
TEST(Theory, SpeedInAChannel) {
  EXPECT_NEAR(value_of("channel_speed", "channel"), 0.03, 1e-12);
}

// rho g sin(10 deg) / mu = 1533.13 1/(m s); depth 0.01 m, uppermost centres at 0.00975 m: h y - y^2/2 =
// 4.996875e-5 m2.
TEST(Theory, SpeedOfAFilm) {
  EXPECT_NEAR(value_of("film_speed", "inclined-film"), 0.0766087, 1e-6);
}

// 0.032 m/s through 0.016 m; (3 x 5.12e-4 m2/s / 1533.13 1/(m s))^(1/3).
TEST(Theory, DepthOfAFilm) {
  EXPECT_NEAR(value_of("film_depth", "open-channel"), 0.0100062, 1e-7);
}

// 0.04 m high, 0.27 m long, 12 degrees: the face is 0.188185 m; (0.27 - 0.178776) / (0.27 - 0.009409).
TEST(Theory, TopOfAHeap) {
  EXPECT_NEAR(value_of("heap_flat_top", "heap"), 0.350065, 1e-5);
  EXPECT_EQ(value_of("heap_flat_top", "s1"), -1.0);
}

// H = 0.1 m * 0.5 / 0.57; density ratio 0.2.
TEST(Theory, PeriodOfAFloatingBed) {
  EXPECT_NEAR(value_of("floating_period", "float-full-r02"), 0.265710, 1e-6);
}

}  // namespace
}  // namespace granvof::compare
