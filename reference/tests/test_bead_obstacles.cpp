// Obstacles in the way of beads, and in the mapping between beads and cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "reference/demvof/beads/bead_engine.hpp"
#include "reference/demvof/coupling/mapping.hpp"
#include "reference/demvof/preparation/disperse.hpp"

namespace {

using demvof::BeadEngine;
using demvof::BeadSettings;
using demvof::BeadState;
using demvof::Mapping;
using demvof::Obstacles;
using demvof::Vector;

constexpr double d = 1e-3, cell = 2e-3;

// Cells of 2 mm of which those in the boxes [lower, upper) are closed.
Obstacles obstacles(std::array<int, 3> cells, double depth,
                    const std::vector<std::array<std::array<int, 3>, 2>>& boxes) {
  Obstacles o;
  o.cells = cells;
  o.spacing = {cell, cell, depth / cells[2]};
  o.closed.assign(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]), 0);
  for (const auto& [lower, upper] : boxes)
    for (int k = lower[2]; k < upper[2]; ++k)
      for (int j = lower[1]; j < upper[1]; ++j)
        for (int i = lower[0]; i < upper[0]; ++i)
          o.closed[static_cast<std::size_t>((k * cells[1] + j) * cells[0] + i)] = 1;
  return o;
}

// A slice with an L of obstacles on its floor: a high part beside a low one, cells 3 to 6.
BeadSettings slice() {
  BeadSettings s;
  s.tank = {0.02, 0.02, 0.006};
  s.diameter = d;
  s.density = 2500.0;
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  s.obstacles = obstacles({10, 10, 1}, 0.006, {{{{3, 0, 0}, {5, 4, 1}}}, {{{5, 0, 0}, {7, 2, 1}}}});
  return s;
}

// The same tank in three dimensions with a block that floats.
BeadSettings room() {
  BeadSettings s = slice();
  s.tank = {0.01, 0.01, 0.01};
  s.periodic_depth = false;
  s.obstacles = obstacles({5, 5, 5}, 0.01, {{{{1, 1, 1}, {4, 3, 4}}}});
  return s;
}

double kinetic(const BeadEngine& engine) {
  return engine.translation_energy() + engine.spin_energy();
}

// Beads whose centre is not farther from an obstacle than this.
int sunk(const BeadSettings& s, const BeadState& beads, double distance) {
  int count = 0;
  for (std::size_t b = 0; b < beads.count(); ++b) {
    bool in = false;
    for (int c = 0; c < static_cast<int>(s.obstacles.closed.size()); ++c) {
      const std::array<int, 3> at{c % s.obstacles.cells[0], c / s.obstacles.cells[0] % s.obstacles.cells[1],
                                  c / s.obstacles.cells[0] / s.obstacles.cells[1]};
      if (!s.obstacles.fill(at)) continue;
      double square = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = beads.position[3 * b + k], h = s.obstacles.spacing[k];
        if (s.obstacles.cells[k] == 1) continue;
        const double away = std::max({at[k] * h - x, x - (at[k] + 1) * h, 0.0});
        square += away * away;
      }
      in = in || square <= distance * distance;
    }
    count += in ? 1 : 0;
  }
  return count;
}

std::vector<double> dispersed(std::size_t count, const Vector& lower, const Vector& upper, bool periodic) {
  std::mt19937 random(1);
  return demvof::disperse_beads(count, lower, upper, periodic, d, random);
}

// How a bead pressed 5e-3 d into what is at `surface` along -`normal` flies away without gravity and loss:
// its speed along the normal and across it, and the energy that it had stored.
struct Rebound {
  double along = 0.0, across = 0.0, stored = 0.0, mass = 0.0;
};
Rebound pressed(BeadSettings s, const Vector& surface, const Vector& normal) {
  s.gravity = 0.0;
  s.law.restitution = 1.0;
  s.dt = 1e-6;
  BeadState bead;
  for (std::size_t k = 0; k < 3; ++k) bead.position.push_back(surface[k] + (0.5 - 5e-3) * d * normal[k]);
  BeadEngine engine(s, bead, {});
  Rebound r;
  r.stored = engine.elastic_energy().walls;
  engine.run(2000);
  const std::vector<double>& v = engine.state().velocity;
  for (std::size_t k = 0; k < 3; ++k) r.along += v[k] * normal[k];
  r.across = std::sqrt(std::max(0.0, v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - r.along * r.along));
  r.mass = engine.bead_mass();
  return r;
}

}  // namespace

// Beads rain on the steps and the floor beside them, and lie still on all three in the end.
TEST(BeadObstacles, BeadsComeToRestOnThemAndNonePasses) {
  const BeadSettings s = slice();
  BeadState beads;
  beads.position = dispersed(600, {0, 0.009, 0}, {0.02, 0.019, 0.006}, true);
  BeadEngine engine(s, beads, {});
  demvof::FluidLoad load;
  load.resize(600);
  engine.set_load(load);
  for (int n = 0; n < 15; ++n) {
    engine.run(1000);
    ASSERT_EQ(sunk(s, engine.state(), 0.4 * d), 0) << n;
  }
  load.coefficient.assign(600, engine.bead_mass() / 0.02);
  engine.set_load(load);
  engine.run(15000);
  EXPECT_EQ(sunk(s, engine.state(), 0.45 * d), 0);
  EXPECT_LT(kinetic(engine), 1e-6 * 600 * engine.bead_mass());
  std::array<int, 3> lie{};  // on the floor, the low step, the high one, in the first layer
  for (std::size_t b = 0; b < 600; ++b) {
    const double x = engine.state().position[3 * b], y = engine.state().position[3 * b + 1];
    if (y < 1.2 * d) ++lie[0];
    if (x > 5 * cell && x < 7 * cell && y < 2 * cell + 0.7 * d) ++lie[1];
    if (x > 3 * cell && x < 5 * cell && y < 4 * cell + 0.7 * d) ++lie[2];
  }
  for (const int n : lie) EXPECT_GT(n, 5);
}

// Shot at faces, edges and corners at ten times the speed of their fall.
TEST(BeadObstacles, NoBeadPassesAtSpeed) {
  const BeadSettings s = room();
  BeadState beads;
  beads.position = dispersed(120, {0, 0.007, 0}, {0.01, 0.01, 0.01}, false);
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 2.0);
  for (std::size_t n = 0; n < beads.position.size(); ++n) beads.velocity.push_back(normal(random));
  BeadEngine engine(s, beads, {});
  for (int n = 0; n < 200; ++n) {
    engine.run(20);
    ASSERT_EQ(sunk(s, engine.state(), 0.0), 0) << n;
  }
  EXPECT_GT(kinetic(engine), 0.01 * 120 * engine.bead_mass());
}

// A face, an edge and a corner push along the line from their nearest point, with the stored energy of a
// plane.
TEST(BeadObstacles, FacesEdgesAndCornersPushAsAPlaneDoes) {
  const double r2 = std::sqrt(0.5), r3 = std::sqrt(1.0 / 3.0);
  struct At {
    BeadSettings settings;
    Vector surface, normal;
  };
  const std::vector<At> places{
      {slice(), {4.1 * cell, 4 * cell, 0.003}, {0, 1, 0}},           // on top
      {slice(), {4.0 * cell, 4 * cell, 0.003}, {0, 1, 0}},           // between two cells
      {slice(), {4.1 * cell, 4 * cell, 0.02 * d}, {0, 1, 0}},        // beside it
      {slice(), {3 * cell + 0.02 * d, 4 * cell, 0.003}, {0, 1, 0}},  // beside an edge
      {slice(), {4.1 * cell, 4 * cell, 0.0}, {0, 1, 0}},             // at the seam of the depth
      {slice(), {3 * cell, 2.5 * cell, 0.003}, {-1, 0, 0}},          // at the side
      {slice(), {3 * cell, 4 * cell, 0.0031}, {-r2, r2, 0}},         // at an edge
      {slice(), {7 * cell, 2 * cell, 0.0}, {0.8, 0.6, 0}},           // at the seam, too
      {room(), {2.3 * cell, 2.3 * cell, cell}, {0, 0, -1}},          // along the depth
      {room(), {2.3 * cell, cell, 2.1 * cell}, {0, -1, 0}},          // from below
      {room(), {cell, 2.3 * cell, 4 * cell}, {-r2, 0, r2}},          // at an upright edge
      {room(), {4 * cell, 3 * cell, cell}, {r3, r3, -r3}}};          // at a corner
  const double modulus = 5e6 / (2.0 * 0.91);
  const double plane = 8.0 / 15.0 * modulus * std::sqrt(0.5 * d) * std::pow(5e-3 * d, 2.5);
  for (const At& at : places) {
    const Rebound r = pressed(at.settings, at.surface, at.normal);
    const std::size_t n = static_cast<std::size_t>(&at - places.data());
    EXPECT_NEAR(r.stored, plane, 1e-3 * plane) << n;
    EXPECT_NEAR(0.5 * r.mass * r.along * r.along, plane, 0.02 * plane) << n;
    EXPECT_LT(r.across, 0.02 * r.along) << n;
  }
}

// On the side of an edge that does not own it LIGGGHTS sees the face and the edge: it pushes at most twice.
TEST(BeadObstacles, BesideAnEdgeTheyPushAtMostTwice) {
  for (const double beside : {0.0, 0.02, 0.05, 0.08, 0.12}) {
    const Rebound r = pressed(slice(), {3 * cell, 4 * cell - beside * d, 0.003}, {-1, 0, 0});
    const double given = 0.5 * r.mass * (r.along * r.along + r.across * r.across) / r.stored;
    EXPECT_GT(given, 0.98) << beside;
    EXPECT_LT(given, beside > 0.1 ? 1.02 : 2.02) << beside;
  }
}

// Beads rain on the obstacles without a fluid: works of all forces make the change of kinetic energy, to
// rounding, and what contacts and walls took is no gain.
TEST(BeadObstacles, TheirWorkIsCounted) {
  const BeadSettings s = slice();
  BeadState beads;
  beads.position = dispersed(300, {0, 0.009, 0}, {0.02, 0.016, 0.006}, true);
  BeadEngine engine(s, beads, {});
  const double start = engine.potential_energy(), pressed_at_start = engine.elastic_energy().beads;
  for (int n = 0; n < 40; ++n) {
    engine.run(100);
    const demvof::ElasticEnergy held = engine.elastic_energy();
    const double given = engine.work().gravity;
    EXPECT_NEAR(kinetic(engine), engine.work().total(), 1e-9 * given) << n;
    EXPECT_LT(engine.work().walls + engine.work().surfaces + held.walls, 1e-3 * given) << n;
    EXPECT_LT(engine.work().contacts + held.beads - pressed_at_start, 1e-3 * given) << n;
  }
  EXPECT_LT(engine.work().surfaces, -0.01 * engine.work().gravity);
  EXPECT_NEAR(start - engine.potential_energy(), engine.work().gravity, 1e-3 * engine.work().gravity);
}

// Beside a gate: it lifts beads that rub on it, and no force of an obstacle drives it; once it is gone the
// obstacle still stands, and its work is still counted.
TEST(BeadObstacles, AGateBesideThemIsDrivenByWhatRubsOnItAlone) {
  BeadSettings s = slice();
  s.gate = 2 * cell;
  s.gate_height = 8 * cell;
  BeadState beads;
  beads.position = dispersed(100, {0.0065, 0.009, 0}, {0.02, 0.016, 0.006}, true);
  BeadEngine engine(s, beads, {});
  engine.run(3000);
  engine.raise_gate(0.1);
  engine.run(500);
  EXPECT_GT(std::abs(engine.work().surfaces), 0.01 * engine.work().gravity);
  EXPECT_EQ(engine.work().gate_drive, 0.0);
  engine.remove_gate();
  const double before = engine.work().surfaces;
  engine.run(2500);
  EXPECT_LT(engine.work().surfaces, 1.5 * before);
  EXPECT_NEAR(kinetic(engine), engine.work().total(), 1e-9 * engine.work().gravity);
  EXPECT_EQ(sunk(s, engine.state(), 0.4 * d), 0);
}

TEST(BeadObstacles, AGateLiftsTheBeadsThatRubOnItBesideThem) {
  BeadSettings s = slice();
  s.gate = 2 * cell;
  s.gate_height = 8 * cell;
  BeadState beads;
  beads.position = dispersed(60, {0, 0, 0}, {2 * cell, 0.012, 0.006}, true);
  for (std::size_t b = 0; b < 60; ++b) beads.velocity.insert(beads.velocity.end(), {0.3, 0.0, 0.0});
  BeadEngine engine(s, beads, {});
  engine.raise_gate(0.1);
  engine.run(500);
  EXPECT_GT(engine.work().gate_drive, 0.0);
}

// Friction holds a bead on an inclined top, and does not where there is none.
TEST(BeadObstacles, TheirFrictionIsTheirOwn) {
  const auto slid = [](double friction) {
    BeadSettings s = slice();
    s.law.wall_friction = 0.0;
    s.law.obstacle_friction = friction;
    BeadState bead;
    bead.position = {3.5 * cell, 4 * cell + 0.5 * d, 0.003};
    BeadEngine engine(s, bead, {});
    engine.set_gravity(9.81, 10.0);
    engine.run(2000);
    // Rolling, not sliding: it spins.
    return engine.spin_energy() / kinetic(engine);
  };
  EXPECT_NEAR(slid(0.0), 0.0, 1e-6);
  EXPECT_NEAR(slid(0.5), 2.0 / 7.0, 0.02);
}

namespace {

double total(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

std::vector<double> weights(Mapping& mapping, const Vector& at) {
  mapping.update({at[0], at[1], at[2]});
  std::vector<double> cells(mapping.cell_count(), 0.0);
  mapping.deposit(1.0, cells);
  return cells;
}

}  // namespace

TEST(MappingObstacles, NothingIsPutIntoThemAndNothingIsLost) {
  const BeadSettings s = slice();
  Mapping mapping(s.obstacles.cells, s.obstacles.spacing, s.obstacles.closed);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 0.02);
  for (int n = 0; n < 500; ++n) {
    const double x = share(random), y = share(random);
    if (s.obstacles.fill({static_cast<int>(x / cell), static_cast<int>(y / cell), 0})) {
      EXPECT_THROW(weights(mapping, {x, y, 0.003}), std::runtime_error);
      continue;
    }
    const std::vector<double> cells = weights(mapping, {x, y, 0.003});
    EXPECT_NEAR(total(cells), 1.0, 1e-12);
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (s.obstacles.closed[c] != 0) {
        EXPECT_EQ(cells[c], 0.0);
      }
  }
}

// Along walls of obstacles it maps as along those of a tank of that size.
TEST(MappingObstacles, ATankMadeSmallerByThemIsOneOfThatSize) {
  const Obstacles o = obstacles({10, 8, 1}, 0.006, {{{{7, 0, 0}, {10, 8, 1}}}, {{{0, 0, 0}, {10, 2, 1}}}});
  Mapping large(o.cells, o.spacing, o.closed), small({7, 6, 1}, o.spacing);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const double x = 7 * cell * share(random), y = 6 * cell * share(random);
    const std::vector<double> found = weights(large, {x, y + 2 * cell, 0.0}),
                              expected = weights(small, {x, y, 0.0});
    for (std::size_t c = 0; c < expected.size(); ++c)
      EXPECT_NEAR(found[(c / 7 + 2) * 10 + c % 7], expected[c], 1e-12);
  }
}

// A jump would be a source of volume: none round an edge that stands out, nor in a corner.
TEST(MappingObstacles, ABeadThatGoesRoundThemLeavesNoJump) {
  const BeadSettings s = slice();
  Mapping mapping(s.obstacles.cells, s.obstacles.spacing, s.obstacles.closed);
  std::vector<double> before;
  const auto go = [&](const Vector& from, const Vector& to) {
    for (int n = 0; n <= 1000; ++n) {
      const double share = n / 1000.0;
      const std::vector<double> now =
          weights(mapping, {std::lerp(from[0], to[0], share), std::lerp(from[1], to[1], share), 0.003});
      for (std::size_t c = 0; c < now.size() && !before.empty(); ++c)
        EXPECT_NEAR(now[c], before[c], 0.02) << from[0] << ' ' << from[1] << ' ' << share;
      before = now;
    }
  };
  const double gap = 0.2 * cell;
  const std::vector<Vector> way{{3 * cell - gap, 0.1 * cell, 0},     {3 * cell - gap, 4 * cell + gap, 0},
                                {5 * cell + gap, 4 * cell + gap, 0}, {5 * cell + gap, 2 * cell + gap, 0},
                                {7 * cell + gap, 2 * cell + gap, 0}, {7 * cell + gap, 0.1 * cell, 0}};
  for (std::size_t n = 1; n < way.size(); ++n) go(way[n - 1], way[n]);
}
