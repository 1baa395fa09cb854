// Each part of the fluid that is sealed from the rest has its own level of pressure.
#include <cmath>

#include "solver/operators/mixture.hpp"
#include "solver/tests/run/override_sets.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::joined;
using test::Set;
using test::Simulation;

// The uppermost cells of a part: columns from `begin` to before `end`, in a row and all along z.
struct Ceiling {
  int begin, end, row;
};

// Mean of P_c taken half a cell up to the ceiling by the weight of the fluid in its cells [Pa].
double level_of(const Simulation& run, const Ceiling& ceiling) {
  const Layout& l = run.grid.cells;
  double sum = 0.0;
  for (int k = 0; k < l.n[2]; ++k)
    for (int i = ceiling.begin; i < ceiling.end; ++i) {
      const std::ptrdiff_t c = l.index(i, ceiling.row, k);
      sum += run.now.p_c[c] - 0.5 * run.grid.h[1] * run.scene.gravity *
                                  mixture(run.now.alpha[c], run.scene.liquid.density, run.scene.gas.density);
    }
  return sum / ((ceiling.end - ceiling.begin) * l.n[2]);
}

struct Parts {
  std::string name;
  std::vector<Ceiling> ceilings;  // of those without an open side
  Set overrides;
};
void PrintTo(const Parts& parts, std::ostream* out) {
  *out << parts.name;
}

// 16 x 16 cells of 5 mm, grains that settle at its right end.
Scene tank(const Set& overrides) {
  return test::small_tank("parts", "size = [0.08, 0.08]", 0.06, R"([walls]
all = "slip"
[bed]
x = 0.05
y = 0.01
length = 0.03
height = 0.015
solid_fraction = 0.5
)",
                          overrides);
}

class SealedParts : public ::testing::TestWithParam<Parts> {};

// From the start to the last step, while the grains in them settle.
TEST_P(SealedParts, HaveTheirLevelAtTheirOwnCeiling) {
  const Parts& parts = GetParam();
  Simulation run(tank(parts.overrides));
  std::vector<double> off(parts.ceilings.size(), 0.0);
  const auto look = [&] {
    for (std::size_t part = 0; part < off.size(); ++part)
      off[part] = std::fmax(off[part], std::fabs(level_of(run, parts.ceilings[part])));
  };
  look();
  while (run.now.time < 0.05 && !HasFatalFailure()) {
    run.advance();
    look();
  }
  ASSERT_FALSE(HasFatalFailure());
  for (std::size_t part = 0; part < off.size(); ++part) EXPECT_LT(off[part], 1e-9) << "part " << part;
  EXPECT_GT(run.fastest(run.now.u_s), 1e-3);
}

const Set open_top{"walls.top=open"};
// From the floor to the lid.
const Set wall{"obstacle.x0=[0.04]", "obstacle.x1=[0.045]", "obstacle.y0=[0]", "obstacle.y1=[0.08]"};
// A pocket at the right end, below a plate at half the height.
const Set pocket{"obstacle.x0=[0.04, 0.045]", "obstacle.x1=[0.045, 0.08]", "obstacle.y0=[0, 0.04]",
                 "obstacle.y1=[0.045, 0.045]"};
// From one side to the other.
const Set plate{"obstacle.x0=[0]", "obstacle.x1=[0.08]", "obstacle.y0=[0.04]", "obstacle.y1=[0.045]"};
// In the middle of the tank, grains and all, open nowhere.
const Set chamber{"obstacle.x0=[0.02, 0.05, 0.025, 0.025]",
                  "obstacle.x1=[0.025, 0.055, 0.05, 0.05]",
                  "obstacle.y0=[0.01, 0.01, 0.01, 0.045]",
                  "obstacle.y1=[0.05, 0.05, 0.015, 0.05]",
                  "bed.x=0.025",
                  "bed.length=0.025",
                  "bed.y=0.02"};
const Set deep{"scene.dimensions=3", "tank.size=[0.08, 0.08, 0.02]"};
// Shut all along.
const Set gate{"bed.x=0", "gate.position=0.04", "gate.speed=1e-6", "time.hold=0.05"};

INSTANTIATE_TEST_SUITE_P(
    Tanks, SealedParts,
    ::testing::Values(Parts{"parted_by_a_wall", {{0, 8, 15}, {9, 16, 15}}, wall},
                      Parts{"parted_by_a_wall_on_a_slope",
                            {{0, 8, 15}, {9, 16, 15}},
                            joined({wall, {"tank.inclination=0.001"}})},
                      Parts{"pocket_beside_an_open_tank", {{9, 16, 7}}, joined({pocket, open_top})},
                      Parts{"pocket_of_gas_beside_an_open_tank",
                            {{9, 16, 7}},
                            joined({pocket,
                                    open_top,
                                    {"liquid.box.origin=[0, 0]", "liquid.box.size=[0.04, 0.06]",
                                     "liquid.level=0.005"}})},
                      Parts{"pocket_in_a_sealed_tank", {{0, 16, 15}, {9, 16, 7}}, pocket},
                      Parts{"under_a_plate_from_side_to_side", {{0, 16, 7}}, joined({plate, open_top})},
                      Parts{"on_both_sides_of_a_plate", {{0, 16, 15}, {0, 16, 7}}, plate},
                      Parts{"chamber_in_an_open_tank", {{5, 10, 8}}, joined({chamber, open_top})},
                      Parts{"chamber_between_periodic_ends",
                            {{0, 16, 15}, {5, 10, 8}},
                            joined({chamber, {"walls.left=periodic", "walls.right=periodic"}})},
                      Parts{"in_3d", {{0, 16, 15}, {9, 16, 7}}, joined({pocket, deep})},
                      Parts{"behind_a_shut_gate", {{0, 8, 15}, {8, 16, 15}}, gate},
                      Parts{"behind_a_shut_gate_in_3d", {{0, 8, 15}, {8, 16, 15}}, joined({gate, deep})}),
    [](const auto& instance) { return instance.param.name; });

// The gate rises: two parts become one.
TEST(SealedParts, JoinWhereAGateOpens) {
  Simulation run(tank(joined({gate, {"gate.speed=0.5", "time.hold=0.01"}})));
  bool shut = false, open = false;
  while (run.now.time < 0.03) {
    run.advance();
    ASSERT_FALSE(HasFatalFailure());
    const double left = level_of(run, {0, 8, 15}), right = level_of(run, {8, 16, 15});
    if (run.now.time * 0.5 < 0.5 * run.grid.h[1] - 1e-12) {
      shut = true;
      EXPECT_NEAR(left, 0.0, 1e-9);
      EXPECT_NEAR(right, 0.0, 1e-9);
    } else {
      open = true;
      EXPECT_NEAR(left + right, 0.0, 1e-9);
      EXPECT_GT(std::fabs(left), 1e-3);
    }
  }
  EXPECT_TRUE(shut && open);
}

}  // namespace
}  // namespace granvof
