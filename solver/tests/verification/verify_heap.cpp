// A heap below its angle of friction stays at rest: toe and slope, under water, dry, nearly weightless.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/output/extract_front.hpp"
#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

struct Overrides {
  const char* name;
  std::vector<std::string> set;
};

struct Heap {
  int slope;  // of the face [deg]; friction holds atan(0.40) = 21.8
  Overrides around, choices;
};

std::vector<Heap> heaps() {
  const std::vector<Overrides> around{
      {"under_water", {}},
      {"dry", {"liquid=false"}},
      {"density_matched", {"solid.density=1010"}},
      {"foam_in_air", {"liquid=false", "solid.density=17", "solid.diameter=0.004"}}};
  const std::vector<Overrides> choices{
      {"advised", {"model.preset=advised"}},
      {"sourced", {"model.preset=sourced"}},
      {"sharp",
       {"numerics.bed_surface=part-cells", "model.packing=carried", "numerics.solid_flux=compressive"}}};
  std::vector<Heap> all;
  for (const int slope : {12, 18})
    for (const Overrides& a : around)
      for (const Overrides& c : choices) all.push_back({slope, a, c});
  return all;
}

class HeapAtRest : public ::testing::TestWithParam<Heap> {};

// The place that 99.5 % of the grains have not passed stays within 0.01 of the heap's height, the slope
// within a quarter of a degree, from T = 4 to T = 40. Until T = 4 the heap settles: it is set up at one
// packing, and contacts carry its weight only at one that grows with depth.
TEST_P(HeapAtRest, ToeAndSlopeStay) {
  const Heap& heap = GetParam();
  std::vector<std::string> set{"grid.dx=0.005", "bed.slope=" + std::to_string(heap.slope)};
  set.insert(set.end(), heap.around.set.begin(), heap.around.set.end());
  set.insert(set.end(), heap.choices.set.begin(), heap.choices.set.end());
  Simulation run(shipped_scene("heap", set));
  const double height = run.scene.bed->box.upper[1] - run.scene.bed->box.lower[1];
  const auto toe = [&] { return scalar::front_quantile(cell_fields(run.grid, run.now), run.scene); };
  const auto slope = [&] { return scalar::slope(cell_fields(run.grid, run.now), run.scene); };
  run.until(4.0 * run.scene.times.unit);
  if (HasFatalFailure()) return;
  const auto toe_before = toe(), slope_before = slope();
  ASSERT_TRUE(toe_before && slope_before);
  double toe_moves = 0.0, slope_moves = 0.0;
  int iterations = 0;  // of the friction solve, in any step
  run.until(40.0 * run.scene.times.unit, [&] {
    const auto x = toe(), angle = slope();
    ASSERT_TRUE(x && angle);
    iterations = std::max(iterations, run.last.friction.iterations);
    toe_moves = std::fmax(toe_moves, std::fabs(*x - *toe_before) / height);
    slope_moves = std::fmax(slope_moves, std::fabs(*angle - *slope_before));
  });
  if (HasFatalFailure()) return;
  report("toe_moves_of_height", toe_moves);
  report("slope_moves_deg", slope_moves);
  report("steps", run.steps);
  report("iterations", iterations);
  EXPECT_LT(iterations, 100);
  EXPECT_LT(toe_moves, 0.01);
  EXPECT_LT(slope_moves, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Heaps, HeapAtRest, ::testing::ValuesIn(heaps()), [](const auto& test) {
  const Heap& heap = test.param;
  return "of_" + std::to_string(heap.slope) + "_" + heap.around.name + "_" + heap.choices.name;
});

}  // namespace
}  // namespace granvof::test
