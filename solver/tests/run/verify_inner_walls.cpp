// A wall inside the tank is a wall: a tank that obstacles or the closed gate make smaller runs as one of that
// size does.
#include <cstdio>

#include "solver/scene/scales.hpp"
#include "solver/tests/run/override_sets.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::joined;
using test::name_of;
using test::Set;
using test::Simulation;

constexpr int steps = 12;
constexpr double step = 1e-3;  // [s]
// Of a field's largest value or of its scale: what the solvers leave at tight tolerances, 5e-9 at most in 2D
// and 2e-8 in 3D (of P_c, in the first step).
double agreement_in(int dimensions) {
  return dimensions == 2 ? 1e-8 : 1e-7;
}

// The smaller tank, what is changed in it, and the walls that take its place in the larger one.
struct Walls {
  std::string name;
  std::array<int, 3> offset{};  // cells of the larger tank before the smaller one's
  std::vector<std::string> small, large, both;
};
void PrintTo(const Walls& walls, std::ostream* out) {
  *out << walls.name;
}

// 8 x 8 cells; a column of grains and a column of water that fall.
Scene tank(const std::vector<std::string>& shared, const std::vector<std::string>& own) {
  std::vector<std::string> all{"numerics.dt_max=1e-3"};
  all.insert(all.end(), shared.begin(), shared.end());
  all.insert(all.end(), own.begin(), own.end());
  return test::small_tank("walls", "size = [0.04, 0.04]", 0.02, test::tight_tolerances, all);
}

// visit(name, field of the smaller, of the larger, whether on faces of direction d) of all that moves.
template <typename Visit>
void for_each_pair(Simulation& small, Simulation& large, Visit&& visit) {
  for (const CellQuantity& q : cell_quantities) visit(q.key, small.now.*q.field, large.now.*q.field, -1);
  for (const FaceQuantity& q : face_quantities)
    for (int d = 0; d < small.grid.dim; ++d)
      visit(q.key, (small.now.*q.field)[d], (large.now.*q.field)[d], d);
}

template <typename Visit>
void for_each_twin(const Simulation& small, const Simulation& large, const std::array<int, 3>& offset, int d,
                   Visit&& visit) {
  const Range places = d < 0 ? small.grid.all_cells() : small.grid.all_faces(d);
  for_each_place(places, [&](const std::array<int, 3>& at) {
    std::array<int, 3> there = at;
    for (int axis = 0; axis < 3; ++axis) there[axis] += offset[axis];
    visit(small.grid.cells.index(at), large.grid.cells.index(there));
  });
}

double scale_of(const std::string& field, const Scales& scales) {
  if (field[0] == 'u') return scales.velocity;
  if (field[0] == 'p' && field[1] == '_') return scales.pressure;
  return field == "theta" ? scales.velocity * scales.velocity : 1.0;
}

class InnerWall : public ::testing::TestWithParam<Walls> {};

// Step by step from the same state, so that what the solvers leave is not what grows of it.
TEST_P(InnerWall, IsAWallOfTheTank) {
  const Walls& walls = GetParam();
  Simulation small(tank(walls.both, walls.small)), large(tank(walls.both, walls.large));
  const Scales scales = scales_of(small.scene);
  const double agreement = agreement_in(small.grid.dim);
  double furthest = 0.0;
  for (int i = 0; i < steps; ++i) {
    for_each_pair(small, large, [&](const char*, const Field& a, Field& b, int d) {
      for_each_twin(small, large, walls.offset, d,
                    [&](std::ptrdiff_t here, std::ptrdiff_t there) { b[there] = a[here]; });
    });
    large.fill_ghosts();
    small.advance(step);
    large.advance(step);
    if (HasFatalFailure()) return;
    ASSERT_EQ(small.now.time, large.now.time);
    for_each_pair(small, large, [&](const std::string& name, const Field& a, const Field& b, int d) {
      double apart = 0.0, largest = scale_of(name, scales);
      for_each_twin(small, large, walls.offset, d, [&](std::ptrdiff_t here, std::ptrdiff_t there) {
        apart = std::fmax(apart, std::fabs(a[here] - b[there]));
        largest = std::fmax(largest, std::fabs(a[here]));
      });
      EXPECT_LT(apart, agreement * largest) << name << d << ", step " << i + 1;
      furthest = std::fmax(furthest, apart / largest);
    });
  }
  std::printf("  largest difference %.2g\n", furthest);
  EXPECT_GT(small.fastest(small.now.u_c), 1e-3);
}

const Set open_top{"walls.all=no-slip", "walls.top=open"};
const Set loose{"bed.x=0", "bed.length=0.02", "bed.height=0.025", "bed.solid_fraction=0.55"};
const Set dense{"bed.x=0", "bed.length=0.02", "bed.height=0.025", "bed.solid_fraction=0.58"};
const Set sheared{"bed.x=0", "bed.length=0.04", "bed.height=0.025", "bed.solid_fraction=0.58",
                  "tank.inclination=30"};
const Set full{"bed.x=0", "bed.length=0.04", "bed.height=0.025", "bed.solid_fraction=0.55"};
const Set light{"walls.all=no-slip", "liquid.level=0.04", "solid.density=400", "bed.x=0",
                "bed.length=0.02",   "bed.height=0.0175", "bed.y=0.0225",      "bed.solid_fraction=0.55"};
const Set deep{"scene.dimensions=3", "tank.size=[0.04, 0.04, 0.015]", "bed.z=0",
               "bed.width=0.01",     "model.contact_friction=false",  "numerics.linear_tolerance=1e-10"};
const Set water{"liquid.box.origin=[0, 0]", "liquid.box.size=[0.02, 0.035]", "liquid.level=0.01"};

// Everything 10 mm higher, on two rows of obstacles.
Walls floor_of_obstacles(const std::string& name, const Set& both, bool grains = true) {
  Set higher{"tank.size=[0.04, 0.05]", "liquid.level=0.03", "obstacle.x0=[0]",
             "obstacle.x1=[0.04]",     "obstacle.y0=[0]",   "obstacle.y1=[0.01]"};
  if (grains) higher.emplace_back("bed.y=0.01");
  return {"floor_" + name, {0, 2, 0}, {}, higher, both};
}

// A wall of one cell on the right, and what is beyond it.
Walls wall_of_obstacles(const std::string& name, const Set& both) {
  return {"wall_" + name,
          {0, 0, 0},
          {},
          {"tank.size=[0.06, 0.04]", "obstacle.x0=[0.04]", "obstacle.x1=[0.045]", "obstacle.y0=[0]",
           "obstacle.y1=[0.04]"},
          both};
}

// A lid of two rows of obstacles over a sealed tank, and light grains that rise to it.
Walls lid_of_obstacles(const std::string& name, const Set& both) {
  return {"lid_" + name,
          {0, 0, 0},
          {},
          {"tank.size=[0.04, 0.05]", "obstacle.x0=[0]", "obstacle.x1=[0.04]", "obstacle.y0=[0.04]",
           "obstacle.y1=[0.05]"},
          both};
}

// The gate, which stays shut, and a tank that ends there.
Walls gate(const std::string& name, const Set& both) {
  return {"gate_" + name,
          {0, 0, 0},
          {"walls.right=slip"},
          {"tank.size=[0.07, 0.04]", "gate.position=0.04", "gate.speed=1e-6"},
          both};
}

Set preset(const std::string& word) {
  return {"model.preset=" + word};
}

std::vector<Walls> all_walls() {
  std::vector<Walls> all;
  for (const char* word : {"paper", "advised", "sourced"}) {
    for (const auto& [name, bed] : {std::pair("loose", loose), std::pair("dense", dense)}) {
      const Set both = joined({open_top, bed, preset(word)});
      const std::string what = std::string(word) + "_" + name;
      all.push_back(floor_of_obstacles(what, both));
      all.push_back(wall_of_obstacles(what, both));
    }
    all.push_back(
        floor_of_obstacles(std::string(word) + "_sheared", joined({open_top, sheared, preset(word)})));
    all.push_back(lid_of_obstacles(word, joined({light, preset(word)})));
    all.push_back(gate(word, joined({open_top, loose, preset(word)})));
    all.push_back(gate(std::string(word) + "_full", joined({open_top, full, preset(word)})));
  }
  Walls deep_floor = floor_of_obstacles("deep", joined({open_top, loose, deep}));
  deep_floor.large.front() = "tank.size=[0.04, 0.05, 0.015]";
  all.push_back(deep_floor);
  Walls deep_wall = wall_of_obstacles("deep", joined({open_top, loose, deep}));
  deep_wall.large.front() = "tank.size=[0.06, 0.04, 0.015]";
  all.push_back(deep_wall);
  for (const char* scheme : {"cicsam", "plic"}) {
    for (const char* flux : {"upwind", "limited"}) {
      const Set both = joined({open_top,
                               water,
                               {"solid=false", std::string("numerics.interface_scheme=") + scheme,
                                std::string("numerics.solid_flux=") + flux}});
      const std::string what = std::string("water_") + scheme + "_" + flux;
      all.push_back(floor_of_obstacles(what, both, false));
      all.push_back(wall_of_obstacles(what, both));
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Obstacles, InnerWall, ::testing::ValuesIn(all_walls()), name_of);

}  // namespace
}  // namespace granvof
