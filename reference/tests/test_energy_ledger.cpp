// The energy ledger of a coupled run: each term against what it must be, and all of them together.
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reference/demvof/coupling/energy_ledger.hpp"
#include "reference/demvof/preparation/disperse.hpp"
#include "reference/tests/coupled_tank.hpp"

namespace {

using demvof::BeadEngine;
using demvof::BeadSettings;
using demvof::BeadState;
using demvof::CoupledRun;
using demvof::EnergyLedger;
using demvof::EnergyTerms;
using demvof::FluidSide;
using demvof::test::put_obstacle;
using demvof::test::start;
using demvof::test::tank;
using demvof::test::TankSetup;

constexpr double d = 1e-3;

// A box of beads without fluid.
BeadSettings box() {
  BeadSettings s;
  s.tank = {0.012, 0.012, 0.006};
  s.diameter = d;
  s.density = 2500.0;
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  return s;
}

double kinetic(const BeadEngine& engine) {
  return engine.translation_energy() + engine.spin_energy();
}

// Two beads in a row along x, `gap` between their surfaces, without gravity.
std::unique_ptr<BeadEngine> pair_of_beads(BeadSettings s, double gap, double speed) {
  s.gravity = 0.0;
  BeadState beads;
  const double half = 0.5 * (d + gap);
  beads.position = {0.006 - half, 0.006, 0.003, 0.006 + half, 0.006, 0.003};
  beads.velocity = {speed, 0.0, 0.0, -speed, 0.0, 0.0};
  return std::make_unique<BeadEngine>(s, beads, std::vector<double>{});
}

std::vector<double> dispersed(std::size_t count, const demvof::Vector& upper) {
  std::mt19937 random(1);
  return demvof::disperse_beads(count, {0, 0, 0}, upper, true, d, random);
}

}  // namespace

// Beads rain on a floor, on each other and against a plate that then rises, under a load that changes: the
// works of all forces make the change of kinetic energy, to rounding.
TEST(WorkMeter, WorksOfAllForcesMakeTheChangeOfKineticEnergy) {
  BeadSettings s = box();
  s.gate = 0.0097;
  s.gate_height = 0.011;
  BeadState beads;
  beads.position = dispersed(200, {0.0095, 0.01, 0.006});
  for (std::size_t b = 0; b < 200; ++b)
    beads.velocity.insert(beads.velocity.end(), {0.3, -0.2, 0.0});  // at the plate
  BeadEngine engine(s, beads, {0.011, 0.0, 0.003});
  demvof::FluidLoad load;
  load.resize(200);
  const double thrown = kinetic(engine);
  for (int n = 0; n < 40; ++n) {
    for (std::size_t b = 0; b < 200; ++b) {
      load.coefficient[b] = engine.bead_mass() / 0.05;
      load.velocity[3 * b] = 0.1 * std::cos(0.3 * n);
      load.force[3 * b] = 3.0 * engine.bead_mass() * std::sin(0.2 * n + static_cast<double>(b));
    }
    engine.set_load(load);
    if (n == 15) engine.raise_gate(0.1);
    if (n == 35) engine.remove_gate();
    if (n == 20) engine.set_gravity(-2.0, 10.0);
    engine.run(25);
  }
  const demvof::BeadWork& work = engine.work();
  for (const double part : {work.gravity, work.drag, work.force, work.contacts, work.walls, work.surfaces})
    EXPECT_GT(std::abs(part), 1e-4 * thrown);
  EXPECT_GT(engine.spin_energy(), 1e-3 * engine.translation_energy());
  EXPECT_NEAR(kinetic(engine) - thrown, work.total(), 1e-9 * thrown);
}

// Contacts take (1 - e^2) of the energy of two beads that meet.
TEST(WorkMeter, ContactsTakeWhatRestitutionSays) {
  for (const double e : {0.9, 0.5}) {
    BeadSettings s = box();
    s.law.restitution = e;
    s.dt = 1e-6;
    const auto engine = pair_of_beads(s, 1e-5, 0.1);
    const double before = kinetic(*engine);
    engine->run(2000);
    EXPECT_GT(engine->state().velocity[3], 0.0);  // they have parted
    EXPECT_NEAR(-engine->work().contacts, (1.0 - e * e) * before, 0.01 * before) << e;
    EXPECT_EQ(engine->elastic_energy().beads, 0.0);
  }
}

// What a contact holds is what it gives back where nothing is lost.
TEST(ElasticEnergy, IsWhatBeadsPressedTogetherFlyApartWith) {
  BeadSettings s = box();
  s.law.restitution = 1.0;
  s.dt = 1e-6;
  const auto engine = pair_of_beads(s, -5e-3 * d, 0.0);
  const double stored = engine->elastic_energy().beads;
  EXPECT_GT(stored, 0.0);
  engine->run(2000);
  EXPECT_EQ(engine->elastic_energy().beads, 0.0);
  EXPECT_NEAR(kinetic(*engine), stored, 0.01 * stored);
}

// Faces, an edge that stands out, and no edge in a corner; along a flat side no edge between cells.
TEST(ElasticEnergy, KnowsObstacles) {
  BeadSettings s = box();
  s.obstacles.cells = {6, 6, 1};
  s.obstacles.spacing = {2e-3, 2e-3, 6e-3};
  s.obstacles.closed.assign(36, 0);
  for (const std::size_t c : {2U, 3U, 8U}) s.obstacles.closed[c] = 1;  // an L: two below, one above the left
  const double overlap = 0.01 * d, modulus = s.law.young / (2.0 * (1.0 - 0.09)), near = 0.5 * d - overlap;
  const double wall = 8.0 / 15.0 * modulus * std::sqrt(0.5 * d) * std::pow(overlap, 2.5);
  const auto of = [&](double x, double y) {
    return demvof::elastic_energy(s, {x, y, 0.003}, {}, {}).walls / wall;
  };
  EXPECT_NEAR(of(5e-3, 4e-3 + near), 1.0, 1e-6);                     // on top
  EXPECT_NEAR(of(7e-3, 2e-3 + near), 1.0, 1e-6);                     // on the low one
  EXPECT_NEAR(of(6e-3 + near, 2e-3 + near), 2.0, 1e-6);              // in the corner between
  EXPECT_NEAR(of(4e-3 - near, 2e-3), 1.0, 1e-6);                     // at the side, between two cells
  EXPECT_NEAR(of(4e-3 - 0.6 * near, 4e-3 + 0.8 * near), 1.0, 1e-6);  // at an edge
  EXPECT_EQ(of(4e-3 - 0.8 * d, 4e-3 + 0.8 * d), 0.0);                // away from it
}

TEST(ElasticEnergy, KnowsPlanesPlateAndImages) {
  const BeadSettings s = [] {
    BeadSettings settings = box();
    settings.gate = 0.005;
    return settings;
  }();
  const double overlap = 0.01 * d, modulus = s.law.young / (2.0 * (1.0 - 0.09));
  const double beads = 8.0 / 15.0 * modulus * std::sqrt(0.25 * d) * std::pow(overlap, 2.5),
               wall = beads * std::sqrt(2.0);
  const auto of = [&](const std::vector<double>& mobile, const std::vector<double>& frozen,
                      std::optional<double> edge) { return demvof::elastic_energy(s, mobile, frozen, edge); };
  // Across the periodic depth, with one that is frozen, and not between two frozen ones.
  EXPECT_NEAR(of({0.003, 0.006, 0.0}, {0.003, 0.006, 0.006 - d + overlap}, {}).beads, beads, 1e-6 * beads);
  EXPECT_EQ(of({}, {0.003, 0.006, 0.001, 0.003, 0.006, 0.001 + d - overlap}, {}).beads, 0.0);
  const std::vector<double> on_floor{0.008, 0.5 * d - overlap, 0.003},
      at_plate{0.005 + 0.5 * d - overlap, 0.006, 0.003};
  EXPECT_NEAR(of(on_floor, {}, {}).walls, wall, 1e-6 * wall);
  EXPECT_NEAR(of(at_plate, {}, 0.0).walls, wall, 1e-6 * wall);
  EXPECT_EQ(of(at_plate, {}, 0.007).walls, 0.0);  // the plate has passed it
  EXPECT_EQ(of(at_plate, {}, {}).walls, 0.0);
}

// At its terminal speed a bead loses by drag all that its submerged weight gives.
TEST(EnergyLedger, ALoneBeadLosesItsSubmergedWeightToDrag) {
  const TankSetup s = tank(8, 12, 0.01, 0.02, FluidSide::open);
  CoupledRun run = start(s, {0.04, 0.11, 0.01});
  for (int n = 0; n < 500; ++n) run.step(2e-4);
  EnergyLedger ledger(run);
  const double from = run.beads().state().position[1];
  for (int n = 0; n < 1000; ++n) run.step(2e-4);
  const double fallen = from - run.beads().state().position[1];
  const double given = run.beads().bead_volume() * 1500.0 * 9.81 * fallen;
  const EnergyTerms terms = ledger.terms();
  EXPECT_GT(fallen, 0.01);
  EXPECT_NEAR(terms.drag, given, 0.05 * given);
  EXPECT_NEAR(terms.drag_mean, terms.drag, 0.01 * given);  // alone it is its own mean
  EXPECT_EQ(terms.contacts, 0.0);
  EXPECT_NEAR(terms.walls, 0.0, 1e-12 * given);  // by difference, in which rounding remains
  EXPECT_NEAR(terms.residual, 0.0, 0.01 * given);
}

// What a bed of beads has lost of its height after so many steps, and the account of it [J].
struct Fallen {
  double given;
  EnergyTerms terms;
};
Fallen fall(const TankSetup& s, double share, const demvof::Vector& lower, const demvof::Vector& upper,
            double dt, int steps) {
  std::mt19937 random(2);
  const double volume = std::numbers::pi / 6.0 * std::pow(s.beads.diameter, 3);
  const double box = (upper[0] - lower[0]) * (upper[1] - lower[1]) * (upper[2] - lower[2]);
  const auto count = static_cast<std::size_t>(share * box / volume);
  const auto position = demvof::disperse_beads(count, lower, upper, true, s.beads.diameter, random);
  CoupledRun run = start(s, position, dt);
  EnergyLedger ledger(run);
  const double before = ledger.terms().potential;
  for (int n = 0; n < steps; ++n) run.step(dt);
  const EnergyTerms terms = ledger.terms();
  return {before - terms.potential, terms};
}

// A bed falling through water: potential energy goes into drag, and the budget closes.
TEST(EnergyLedger, AFallingBedLosesItsEnergyToDrag) {
  const auto [given, terms] =
      fall(tank(4, 24, 2.5e-3, 4e-3, FluidSide::slip), 0.4, {0, 0.02, 0}, {0.01, 0.05, 4e-3}, 1e-4, 1500);
  EXPECT_GT(given, 0.0);
  EXPECT_GT(terms.drag, 0.6 * given);
  EXPECT_NEAR(terms.residual, 0.0, 0.01 * given);
}

// Through a gas onto a step, at whose edge it parts: contacts take it, those with the step among them.
TEST(EnergyLedger, ABedThatFallsOnAStepClosesItsBudget) {
  TankSetup s = tank(8, 12, 2.5e-3, 4e-3, FluidSide::slip);
  s.fluid.liquid_density = 1.0;
  s.fluid.liquid_viscosity = 1e-5;
  put_obstacle(s, {4, 0}, {8, 3});
  const auto [given, terms] = fall(s, 0.2, {0, 0.012, 0}, {0.02, 0.027, 4e-3}, 2e-4, 500);
  EXPECT_GT(given, 0.0);
  EXPECT_GT(terms.walls, 0.05 * given);
  EXPECT_NEAR(terms.residual, 0.0, 0.01 * given);
}
