// A level of pressure for each part of the fluid that has no open side, and for no other.
#include <algorithm>
#include <map>
#include <mutex>

#include <gtest/gtest.h>

#include "solver/operators/mixture.hpp"
#include "solver/operators/pressure_level.hpp"
#include "solver/tests/operators/tank.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using test::Tank;

// What the tank of one process, or a slab, makes of the same pressure.
struct Levelled {
  Levelled(Scene given, double time, const Communicator* processes = nullptr)
      : s(std::move(given), processes), aperture(s.grid, s.scene) {
    aperture.update(time);
    const auto wave = [this](double a, double b) {
      return s.cells([=, this](const Vec3& x) {
        const double along = x[0] + s.grid.cells.first[0] * s.grid.h[0],
                     across = x[2] + s.grid.cells.first[2] * s.grid.h[2];
        return std::sin(a * along + b * x[1] + 3.0 * across);
      });
    };
    before = wave(17.0, 29.0);
    alpha = wave(5.0, 7.0);
    s.each_cell([&](int, int, int, std::ptrdiff_t c) {
      before[c] *= 1e3;
      alpha[c] *= alpha[c];
    });
    after = before;
    PressureLevel level(s.grid, s.scene);
    if (level.may_be_parted()) {
      ContinuityTree tree(s.grid);
      tree.grow(aperture);
      level.find_parts(tree);
    }
    level.set(alpha, after);
  }
  Tank s;
  Aperture aperture;
  Field before, alpha, after;
};

// Parts by their own definition: the lowest number of all cells that open faces join, until none changes;
// below all where fluid passes a side.
std::map<std::ptrdiff_t, std::vector<std::array<int, 3>>> parts_of(const Levelled& tank) {
  const Grid& grid = tank.s.grid;
  const Layout& l = grid.cells;
  std::map<std::ptrdiff_t, std::ptrdiff_t> number;
  const char* solid = grid.obstacles.solid();
  tank.s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    if (solid == nullptr || solid[c] == 0) number[c] = c;
  });
  for (int d = 0; d < grid.dim; ++d)
    for (const bool upper : {false, true})
      if (grid.side(d, upper).passes_fluid)
        tank.s.each(grid.side_cells(d, upper), [&](int, int, int, std::ptrdiff_t c) {
          if (number.contains(c)) number[c] = -1;
        });
  for (bool changed = true; changed;) {
    changed = false;
    tank.s.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
      for (int d = 0; d < grid.dim; ++d) {
        std::array<int, 3> below{i, j, k};
        if (--below[d] < 0 && !l.periodic[d]) continue;
        below[d] = (below[d] + l.n[d]) % l.n[d];
        if (tank.aperture[d][c] == 0.0) continue;
        std::ptrdiff_t &here = number.at(c), &there = number.at(l.index(below));
        changed = changed || here != there;
        here = there = std::min(here, there);
      }
    });
  }
  std::map<std::ptrdiff_t, std::vector<std::array<int, 3>>> parts;
  tank.s.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
    parts[number.contains(c) ? number[c] : -2].push_back({i, j, k});
  });
  return parts;
}

struct Tanks {
  std::string name;
  Scene scene;
  std::size_t sealed;  // parts, with the gate shut
};
void PrintTo(const Tanks& tanks, std::ostream* out) {
  *out << tanks.name;
}

// 12 x 8 (x 6) cells of 0.1.
Scene closed(int dim, const std::vector<Box>& obstacles = {}) {
  Scene scene = test::box_scene(dim, {12, 8, dim == 3 ? 6 : 1}, {1.2, 0.8, dim == 3 ? 0.6 : 0.1});
  scene.obstacles = obstacles;
  return scene;
}
Scene with(Scene scene, int side, SideKind kind) {
  scene.sides[side].kind = kind;
  return scene;
}
Scene joined(Scene scene, int d) {
  test::make_periodic(scene, d);
  return scene;
}
Scene gated(Scene scene) {
  scene.gate = Gate{0.5, 1.0};
  return scene;
}
Box box(double x0, double x1, double y0, double y1, double z0 = 0.0, double z1 = 0.6) {
  return {{x0, y0, z0}, {x1, y1, z1}};
}

class PartsOfATank : public ::testing::TestWithParam<Tanks> {};

TEST_P(PartsOfATank, EachHaveTheirLevelAtTheirLid) {
  const Tanks& given = GetParam();
  for (const double time : {-1.0, 0.3, 2.0}) {  // a gate down, in part up, gone
    const Levelled tank(given.scene, time);
    const Layout& l = tank.s.grid.cells;
    std::size_t sealed = 0;
    for (const auto& [number, cells] : parts_of(tank)) {
      const auto shift = [&](const std::array<int, 3>& at) {
        return tank.after[l.index(at)] - tank.before[l.index(at)];
      };
      if (number < 0) {
        for (const auto& at : cells) EXPECT_EQ(shift(at), 0.0);
        continue;
      }
      ++sealed;
      int row = 0;
      for (const auto& at : cells) {
        row = std::max(row, at[1]);
        EXPECT_NEAR(shift(at), shift(cells.front()), 1e-11);
      }
      double sum = 0.0, count = 0.0;
      for (const auto& at : cells) {
        if (at[1] != row) continue;
        const std::ptrdiff_t c = l.index(at);
        sum += tank.after[c] - 0.05 * tank.s.scene.gravity * mixture(tank.alpha[c], 1000.0, 1.0);
        count += 1.0;
      }
      EXPECT_NEAR(sum / count, 0.0, 1e-11) << "part of cell " << number << ", t = " << time;
    }
    if (time < 0.0) {
      EXPECT_EQ(sealed, given.sealed);
    }
  }
}

// Whatever cuts the tank: parts of several slabs, and several of one.
TEST_P(PartsOfATank, AreThoseOfOneProcess) {
  const Tanks& given = GetParam();
  for (const double time : {-1.0, 2.0}) {
    const Levelled whole(given.scene, time);
    for (const int processes : {2, 3}) {
      test::Team team(processes, test::Boxes::slabs);
      std::mutex mutex;
      ASSERT_NO_THROW(team.run([&](int, const Communicator& communicator) {
        const Levelled slab(given.scene, time, &communicator);
        const std::lock_guard lock(mutex);
        const auto& first = slab.s.grid.cells.first;
        slab.s.each_cell([&](int i, int j, int k, std::ptrdiff_t c) {
          const std::ptrdiff_t there = whole.s.grid.cells.index(first[0] + i, first[1] + j, first[2] + k);
          EXPECT_NEAR(slab.after[c], whole.after[there], 1e-11);
        });
      }));
    }
  }
}

// A wall from floor to lid; a pocket below a plate; a closed chamber; one that reaches round a wall.
const Box wall = box(0.5, 0.6, 0.0, 0.8);
const std::vector<Box> pocket{box(0.5, 0.6, 0.0, 0.5), box(0.6, 1.2, 0.4, 0.5)};
const std::vector<Box> chamber{box(0.2, 1.0, 0.1, 0.2), box(0.2, 1.0, 0.6, 0.7), box(0.2, 0.3, 0.2, 0.6),
                               box(0.9, 1.0, 0.2, 0.6)};
const std::vector<Box> bent{box(0.2, 0.3, 0.0, 0.7), box(0.2, 1.2, 0.6, 0.7), box(0.6, 0.7, 0.2, 0.6)};

// Higher at one end than at the other.
const std::vector<Box> stepped{box(0.1, 0.2, 0.0, 0.7), box(0.2, 0.4, 0.6, 0.7), box(0.3, 0.4, 0.3, 0.6),
                               box(0.4, 1.2, 0.3, 0.4)};

INSTANTIATE_TEST_SUITE_P(
    All, PartsOfATank,
    ::testing::Values(Tanks{"closed", closed(2), 1}, Tanks{"open", with(closed(2), top, SideKind::open), 0},
                      Tanks{"wall", closed(2, {wall}), 2}, Tanks{"wall_in_3d", closed(3, {wall}), 2},
                      Tanks{"wall_between_joined_ends", joined(closed(2, {wall}), 0), 1},
                      Tanks{"wall_and_an_outlet", with(closed(2, {wall}), right, SideKind::outlet), 1},
                      Tanks{"gate", gated(closed(2)), 2}, Tanks{"gate_in_3d", gated(closed(3)), 2},
                      Tanks{"gate_under_an_open_top", gated(with(closed(2), top, SideKind::open)), 0},
                      Tanks{"gate_and_an_outlet", gated(with(closed(2), left, SideKind::outlet)), 1},
                      Tanks{"gate_between_joined_ends", gated(joined(closed(2), 0)), 1},
                      Tanks{"pocket", closed(2, pocket), 2},
                      Tanks{"pocket_beside_an_open_tank", with(closed(2, pocket), top, SideKind::open), 1},
                      Tanks{"pocket_of_a_joined_vertical", joined(closed(2, pocket), 1), 1},
                      Tanks{"plate", with(closed(2, {box(0.0, 1.2, 0.4, 0.5)}), top, SideKind::open), 1},
                      Tanks{"plate_of_a_joined_vertical", joined(closed(2, {box(0.0, 1.2, 0.4, 0.5)}), 1), 1},
                      Tanks{"chamber", with(closed(2, chamber), top, SideKind::open), 1},
                      Tanks{"chamber_between_joined_ends", joined(closed(2, chamber), 0), 2},
                      Tanks{"bent", with(closed(2, bent), top, SideKind::open), 1},
                      Tanks{"stepped", with(closed(2, stepped), top, SideKind::open), 1},
                      Tanks{"bent_in_3d", joined(with(closed(3, bent), top, SideKind::open), 2), 1},
                      Tanks{"plates_across_z",
                            closed(3, {box(0.0, 1.2, 0.0, 0.8, 0.2, 0.3), box(0.0, 1.2, 0.0, 0.8, 0.4, 0.5)}),
                            3}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace granvof
