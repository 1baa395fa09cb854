// What a scene does may not depend on which of its sides is called left, on the name of a horizontal
// direction, on how many threads there are, nor on whether the run was stopped and gone on with. Six scenes,
// each with every preset. (Shifts: verify_periodic; units: verify_units; depth and output: the rows of
// invariance in compare/checks.toml, of the same scenes.)
//
// Mirrored and exchanged states are run on step by step, each step from the same state: sums in another order
// change the last digit, which an iteration that is stopped at its tolerance turns into more. So the bound
// is on what one step makes of it, at the tolerances set here.
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>

#include "solver/scene/scales.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof {
namespace {

using test::Simulation;

constexpr int steps = 12;
// Of the largest value of a field, after one step.
constexpr double agreement = 1e-6;

struct Choice {
  std::string scene, preset;
};
void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.scene << ", " << choice.preset;
}

Scene small_scene(const Choice& choice, std::vector<std::string> overrides = {}) {
  overrides.push_back("model.preset=" + choice.preset);
  return load_scene(GRANVOF_CASES_DIR "/invariance/" + choice.scene + ".toml", overrides);
}

const std::vector<std::string> tightly_solved{"numerics.volume_tolerance=1e-12",
                                              "numerics.linear_tolerance=1e-8"};

// Where a place is in the other run, and which component is which there with which sign.
struct Mirror {
  static constexpr int component(int d) { return d; }
  static constexpr double sign(int d) { return d == 0 ? -1.0 : 1.0; }
  // Cells, or faces of direction d.
  static std::array<int, 3> place(const Layout& l, std::array<int, 3> at, int d) {
    at[0] = (d == 0 ? l.n[0] : l.n[0] - 1) - at[0];
    return at;
  }
};
struct Exchange {
  static constexpr int component(int d) { return 2 - d; }
  static constexpr double sign(int) { return 1.0; }
  static std::array<int, 3> place(const Layout&, std::array<int, 3> at, int) { return {at[2], at[1], at[0]}; }
};

constexpr int cells = -1;  // in place of the direction of faces

template <typename Visit>
void for_each_place(const Grid& grid, int d, Visit&& visit) {
  std::array<int, 3> n = grid.cells.n;
  if (d != cells) ++n[d];
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) visit(std::array{i, j, k});
}

std::ptrdiff_t index(const Grid& grid, const std::array<int, 3>& at) {
  return grid.cells.index(at);
}

// visit(name, field, the other run's field, direction of faces or `cells`, sign) of every field of two
// states.
template <typename Map, typename S, typename T, typename Visit>
void for_each_field(S& a, T& b, int dimensions, Visit&& visit) {
  visit("f_s", a.f_s, b.f_s, cells, 1.0);
  visit("alpha", a.alpha, b.alpha, cells, 1.0);
  visit("p_c", a.p_c, b.p_c, cells, 1.0);
  visit("p_s", a.p_s, b.p_s, cells, 1.0);
  visit("theta", a.theta, b.theta, cells, 1.0);
  visit("phi", a.phi, b.phi, cells, 1.0);
  visit("packing", a.packing, b.packing, cells, 1.0);
  for (int d = 0; d < dimensions; ++d) {
    const int e = Map::component(d);
    visit("u_s", a.u_s[d], b.u_s[e], d, Map::sign(d));
    visit("u_c", a.u_c[d], b.u_c[e], d, Map::sign(d));
    visit("u_strain", a.u_strain[d], b.u_strain[e], d, Map::sign(d));
  }
}

template <typename Map>
void copy_mapped(const Simulation& from, Simulation& to) {
  to.now.time = from.now.time;
  for_each_field<Map>(
      from.now, to.now, from.grid.dim, [&](const char*, const Field& a, Field& b, int d, double sign) {
        for_each_place(from.grid, d, [&](const std::array<int, 3>& at) {
          b[index(to.grid, Map::place(from.grid.cells, at, d))] = sign * a[index(from.grid, at)];
        });
      });
  to.fill_ghosts();
}

struct Difference {
  double largest = 0.0;
  std::string field = "none";
};

// Over the field's largest value or, where that is more, its scale: grains at rest, or falling together, have
// velocities, P_s and Theta that are nothing but what the solvers leave.
double scale_of(const std::string& field, const Scene& scene) {
  const Scales s = scales_of(scene);
  if (field[0] == 'u') return s.velocity;
  if (field[0] == 'p' && field[1] == '_') return s.pressure;
  return field == "theta" ? s.velocity * s.velocity : 0.0;
}
template <typename Map>
Difference difference(const Simulation& given, const Simulation& other) {
  Difference worst;
  for_each_field<Map>(
      given.now, other.now, given.grid.dim,
      [&](const std::string& name, const Field& a, const Field& b, int d, double sign) {
        double most = scale_of(name, given.scene), off = 0.0;
        for_each_place(given.grid, d, [&](const std::array<int, 3>& at) {
          const double x = a[index(given.grid, at)];
          most = std::fmax(most, std::fabs(x));
          off =
              std::fmax(off, std::fabs(sign * b[index(other.grid, Map::place(given.grid.cells, at, d))] - x));
        });
        if (most > 0.0 && off > worst.largest * most) worst = {off / most, name};
      });
  return worst;
}

template <typename Map>
void expect_same(const Scene& scene, const Scene& mapped) {
  Simulation given(scene), other(mapped);
  double furthest = 0.0;
  for (int i = 0; i < steps; ++i) {
    copy_mapped<Map>(given, other);
    ASSERT_EQ(difference<Map>(given, other).largest, 0.0);
    given.advance();
    other.advance();
    if (::testing::Test::HasFatalFailure()) return;
    const Difference d = difference<Map>(given, other);
    EXPECT_LT(d.largest, agreement) << d.field << ", step " << i + 1;
    furthest = std::fmax(furthest, d.largest);
  }
  std::printf("  largest difference %.2g\n", furthest);
  EXPECT_GT(given.fastest(given.now.u_s), 0.0);
}

class Invariance : public ::testing::TestWithParam<Choice> {
 protected:
  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }

 private:
  test::TemporaryDirectory directory_;
};

TEST_P(Invariance, MirroredInX) {
  const Scene scene = small_scene(GetParam(), tightly_solved);
  Scene mirrored = scene;
  std::swap(mirrored.sides[left], mirrored.sides[right]);
  if (mirrored.gate) mirrored.gate->position = scene.tank[0] - scene.gate->position;
  expect_same<Mirror>(scene, mirrored);
}

// A slice of one cell, without the gate: that rises across x alone.
TEST_P(Invariance, XAndZExchanged) {
  Scene scene = small_scene(GetParam(), tightly_solved);
  scene.gate.reset();
  scene.dimensions = 3;
  scene.tank[2] = scene.grid.spacing[2] = scene.grid.spacing[0];
  scene.bed->box.upper[2] = scene.tank[2];
  for (Box& box : scene.liquid_boxes) box.upper[2] = scene.tank[2];
  for (const int side : {front, back})
    scene.sides[side].fluid.kind = scene.sides[side].solid.kind = WallKind::slip;
  Scene exchanged = scene;
  std::swap(exchanged.tank[0], exchanged.tank[2]);
  std::swap(exchanged.grid.cells[0], exchanged.grid.cells[2]);
  std::swap(exchanged.sides[left], exchanged.sides[front]);
  std::swap(exchanged.sides[right], exchanged.sides[back]);
  for (Box* box : {&exchanged.bed->box}) {
    std::swap(box->lower[0], box->lower[2]);
    std::swap(box->upper[0], box->upper[2]);
  }
  for (Box& box : exchanged.liquid_boxes) std::swap(box.upper[0], box.upper[2]);
  expect_same<Exchange>(scene, exchanged);
}

// To the bit. Stopped at half its length, and gone on with by two threads.
TEST_P(Invariance, ThreadsAndARestart) {
  const Scene whole = small_scene(GetParam(), {"output.field_times=[0]"});
  const double end = 0.5 * whole.times.end / whole.times.unit;
  const Scene half = small_scene(GetParam(), {"time.end=" + std::to_string(end), "output.field_times=[0]"});
  ASSERT_EQ(test::run_into(path("whole"), whole), 0);
  ASSERT_EQ(test::run_into(path("parts"), half), 0);
  EXPECT_NE(test::text_of(path("whole") / "series.csv"), test::text_of(path("parts") / "series.csv"));
  ASSERT_EQ(test::run_into(path("parts"), whole, true, 2), 0);
  EXPECT_EQ(test::text_of(path("whole") / "series.csv"), test::text_of(path("parts") / "series.csv"));
}

std::vector<Choice> all_choices() {
  std::vector<Choice> all;
  for (const char* scene : {"column", "slope", "dry", "piston", "raft", "suspension"})
    for (const char* preset : {"paper", "sourced", "advised"}) all.push_back({scene, preset});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Invariance, ::testing::ValuesIn(all_choices()),
                         [](const auto& c) { return c.param.scene + "_" + c.param.preset; });

}  // namespace
}  // namespace granvof
