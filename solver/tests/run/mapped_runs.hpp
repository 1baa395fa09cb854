// A scene and what it becomes in a mirror or with two axes exchanged, run side by side.
//
// States are mapped and run on step by step, each step from the same state: sums in another order change the
// last digit, which an iteration that is stopped at its tolerance turns into more. So the bound is on what
// one step makes of it, at tight tolerances.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "solver/scene/scales.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof::test {

// Of the largest value of a field, after one step.
inline constexpr double mapped_agreement = 1e-6;

inline constexpr int cells = -1;  // in place of the direction of faces

// Where a place is in the other run, and which component is which there with which sign.
class Mapping {
 public:
  static Mapping mirror(int axis) { return {{0, 1, 2}, axis}; }
  static Mapping exchange(int a, int b) {
    Mapping m{{0, 1, 2}, -1};
    std::swap(m.axis_[a], m.axis_[b]);
    return m;
  }

  int axis(int d) const { return axis_[d]; }
  double sign(int d) const { return d == mirrored_ ? -1.0 : 1.0; }
  // Of cells, or of faces of direction d, n: cells of the first run.
  std::array<int, 3> place(const std::array<int, 3>& n, const std::array<int, 3>& at, int d) const {
    std::array<int, 3> there{};
    for (int c = 0; c < 3; ++c) there[axis_[c]] = c == mirrored_ ? (d == c ? n[c] : n[c] - 1) - at[c] : at[c];
    return there;
  }

  // Gates stand across x and do not change axes; beds have a box's shape.
  Scene operator()(const Scene& scene) const {
    Scene other = scene;
    for (int d = 0; d < 3; ++d) {
      const int e = axis_[d];
      other.tank[e] = scene.tank[d];
      other.grid.cells[e] = scene.grid.cells[d];
      other.grid.spacing[e] = scene.grid.spacing[d];
      for (const int upper : {0, 1}) {
        Side& side = other.sides[2 * e + (d == mirrored_ ? 1 - upper : upper)];
        side = scene.sides[2 * d + upper];
        // Beyond an outlet there is liquid as high as the tank, or up to a level that no map moves.
        if (side.outflow.level == scene.tank[1]) side.outflow.level = scene.tank[axis_[1]];
        for (int c = 0; c < 3; ++c)
          side.velocity[axis_[c]] = sign(c) * scene.sides[2 * d + upper].velocity[c];
      }
    }
    if (other.bed) map_box(scene, other.bed->box);
    for (Box& box : other.liquid_boxes) map_box(scene, box);
    for (Box& box : other.obstacles) map_box(scene, box);
    if (mirrored_ == 0) {
      if (other.gate) other.gate->position = scene.tank[0] - scene.gate->position;
      other.inclination = -scene.inclination;
    }
    return other;
  }

 private:
  Mapping(std::array<int, 3> axis, int mirrored) : axis_(axis), mirrored_(mirrored) {}

  void map_box(const Scene& scene, Box& box) const {
    const Box given = box;
    for (int d = 0; d < 3; ++d) {
      const bool turned = d == mirrored_;
      box.lower[axis_[d]] = turned ? scene.tank[d] - given.upper[d] : given.lower[d];
      box.upper[axis_[d]] = turned ? scene.tank[d] - given.lower[d] : given.upper[d];
    }
  }

  std::array<int, 3> axis_;  // of the other run
  int mirrored_;             // axis, or none
};

template <typename Visit>
void for_each_place(const Grid& grid, int d, Visit&& visit) {
  std::array<int, 3> n = grid.cells.n;
  if (d != cells) ++n[d];
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) visit(std::array{i, j, k});
}

// visit(name, field, the other run's field, direction of faces or `cells`, sign) of every field of two
// states.
template <typename S, typename T, typename Visit>
void for_each_field(S& a, T& b, int dimensions, const Mapping& map, Visit&& visit) {
  visit("f_s", a.f_s, b.f_s, cells, 1.0);
  visit("alpha", a.alpha, b.alpha, cells, 1.0);
  visit("p_c", a.p_c, b.p_c, cells, 1.0);
  visit("p_s", a.p_s, b.p_s, cells, 1.0);
  visit("theta", a.theta, b.theta, cells, 1.0);
  visit("phi", a.phi, b.phi, cells, 1.0);
  visit("packing", a.packing, b.packing, cells, 1.0);
  for (int d = 0; d < dimensions; ++d) {
    const int e = map.axis(d);
    visit("u_s", a.u_s[d], b.u_s[e], d, map.sign(d));
    visit("u_c", a.u_c[d], b.u_c[e], d, map.sign(d));
    visit("u_strain", a.u_strain[d], b.u_strain[e], d, map.sign(d));
  }
}

inline void copy_mapped(const Simulation& from, Simulation& to, const Mapping& map) {
  to.now.time = from.now.time;
  const std::array<int, 3>& n = from.grid.cells.n;
  for_each_field(from.now, to.now, from.grid.dim, map,
                 [&](const char*, const Field& a, Field& b, int d, double sign) {
                   for_each_place(from.grid, d, [&](const std::array<int, 3>& at) {
                     b[to.grid.cells.index(map.place(n, at, d))] = sign * a[from.grid.cells.index(at)];
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
inline double scale_of(const std::string& field, const Scene& scene) {
  const Scales s = scales_of(scene);
  if (field[0] == 'u') return s.velocity;
  if (field[0] == 'p' && field[1] == '_') return s.pressure;
  return field == "theta" ? s.velocity * s.velocity : 0.0;
}

inline Difference difference(const Simulation& given, const Simulation& other, const Mapping& map) {
  Difference worst;
  const std::array<int, 3>& n = given.grid.cells.n;
  for_each_field(given.now, other.now, given.grid.dim, map,
                 [&](const std::string& name, const Field& a, const Field& b, int d, double sign) {
                   double most = scale_of(name, given.scene), off = 0.0;
                   for_each_place(given.grid, d, [&](const std::array<int, 3>& at) {
                     const double x = a[given.grid.cells.index(at)];
                     most = std::fmax(most, std::fabs(x));
                     off =
                         std::fmax(off, std::fabs(sign * b[other.grid.cells.index(map.place(n, at, d))] - x));
                   });
                   if (most > 0.0 && off > worst.largest * most) worst = {off / most, name};
                 });
  return worst;
}

inline void expect_same(const Scene& scene, const Scene& mapped, const Mapping& map, int steps) {
  Simulation given(scene), other(mapped);
  double furthest = 0.0;
  for (int i = 0; i < steps; ++i) {
    copy_mapped(given, other, map);
    ASSERT_EQ(difference(given, other, map).largest, 0.0);
    given.advance();
    other.advance();
    if (::testing::Test::HasFatalFailure()) return;
    const Difference d = difference(given, other, map);
    EXPECT_LT(d.largest, mapped_agreement) << d.field << ", step " << i + 1;
    furthest = std::fmax(furthest, d.largest);
  }
  std::printf("  largest difference %.2g\n", furthest);
  EXPECT_GT(given.fastest(given.now.u_s), 0.0);
}

}  // namespace granvof::test
