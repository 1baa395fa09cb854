// Tests of the beads' material: each against what it must find where that is known.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "reference/demvof/element/cooling.hpp"
#include "reference/demvof/element/first_flow.hpp"
#include "reference/demvof/element/material.hpp"
#include "reference/demvof/element/wall_friction.hpp"
#include "reference/tests/small_case.hpp"
#include "solver/closures/contact_pressure.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

demvof::LayerSettings small_layer() {
  demvof::LayerSettings s;
  s.diameter = 1e-3;
  s.density = 2500.0;
  s.length = s.depth = 6.0;
  s.layer = 10.0;
  s.scratch_folder = (std::filesystem::temp_directory_path() / "demvof-tests").string();
  return s;
}

demvof::ElementTests made_up() {
  demvof::ElementTests t;
  for (int n = 1; n <= 8; ++n) {
    demvof::ChutePoint point;
    point.friction.inertial_number = 0.03 * n;
    point.friction.friction = 0.3 + 0.1 * n / (n + 5.0);
    point.solid_fraction = 0.59 - 0.2 * point.friction.inertial_number;
    point.load = 80.0;
    t.chute.points.push_back(point);
  }
  t.friction.law = {0.3, 0.6, 0.25};
  t.friction.band = {0.01, 0.04, 0.07};
  t.loosest = {{0.586, 0.002}, 100.0};
  t.densest = {{0.64, 0.002}, 100.0};
  t.first.push_back({19.0, {}, {}});
  t.first_friction.law = {0.35, 0.7, 0.4};
  t.critical = demvof::critical_packing(t.chute, t.critical_load);
  t.restitution = {0.72, 0.01};
  t.chute.stopped_at = 16.0;
  return t;
}

}  // namespace

TEST(Measured, ABandIsTwiceTheStandardErrorOfTheMean) {
  const demvof::Measured mean = demvof::mean_of({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(mean.value, 2.0);
  EXPECT_NEAR(mean.band, 2.0 * 1.0 / std::sqrt(3.0), 1e-12);
  EXPECT_THROW(demvof::mean_of({1.0}), std::invalid_argument);
}

TEST(Measured, ALineMeetsTheAxisWhereItsPointsSay) {
  const demvof::Measured exact = demvof::intercept_of({1.0, 2.0, 4.0}, {3.0, 5.0, 9.0});
  EXPECT_NEAR(exact.value, 1.0, 1e-12);
  EXPECT_NEAR(exact.band, 0.0, 1e-6);
  const demvof::Measured loose = demvof::intercept_of({1.0, 2.0, 3.0, 4.0}, {3.1, 4.9, 7.1, 8.9});
  EXPECT_NEAR(loose.value, 1.0, loose.band);
  EXPECT_GT(loose.band, 0.1);
  EXPECT_THROW(demvof::intercept_of({1.0, 1.0, 1.0}, {1.0, 2.0, 3.0}), std::invalid_argument);
  EXPECT_THROW(demvof::intercept_of({1.0, 2.0}, {1.0, 2.0}), std::invalid_argument);
}

TEST(Material, GrainsTouchWhereTheLawBearsTheLoadOfTheTest) {
  const granvof::Contact contact = demvof::test::small().contact;
  const double touching = demvof::touching_fraction(contact, 0.586, 100.0);
  EXPECT_LT(touching, 0.586);
  EXPECT_NEAR(granvof::closures::elastic_pressure(0.586, contact, touching).value, 100.0, 1e-6);
  EXPECT_DOUBLE_EQ(demvof::touching_fraction(contact, 0.586, 0.0), 0.586);
}

// Windows of fast flow, whose packing falls more, are not asked.
TEST(Material, TheCriticalPackingIsThatOfSlowFlow) {
  demvof::ElementTests t = made_up();
  t.chute.points.push_back(t.chute.points.back());
  t.chute.points.back().friction.inertial_number = 0.4;
  t.chute.points.back().solid_fraction = 0.4;
  double load = 0.0;
  const demvof::Measured critical = demvof::critical_packing(t.chute, load);
  EXPECT_NEAR(critical.value, 0.59, 1e-9);
  EXPECT_NEAR(load, 80.0, 1e-9);
}

// Windows before the packing breaks and the chute's slow ones are not asked; its fast ones are.
TEST(Material, FrictionOfFirstStrainIsItsOwnWhereItHasWindows) {
  const demvof::FrictionLaw first{0.36, 0.7, 0.4}, later{0.28, 0.6, 0.3};
  demvof::FirstFlow flow;
  demvof::ChuteResult chute;
  const auto point = [](double inertia, double friction) {
    demvof::ChutePoint p;
    p.friction = {inertia, friction};
    return p;
  };
  for (int n = 1; n <= 14; ++n) {
    const double inertia = 0.01 * n;
    flow.points.push_back(point(inertia, n == 1 ? 0.6 : first(inertia)));
    flow.strain.push_back(n == 1 ? 0.1 : 0.4 * n);
    chute.points.push_back(point(inertia, later(inertia)));
    chute.points.push_back(point(0.15 + inertia, first(0.15 + inertia)));
  }
  const demvof::FrictionFit fit = demvof::fit_of_first({flow}, chute);
  EXPECT_NEAR(fit.law.at_rest, first.at_rest, 1e-3);
  EXPECT_NEAR(fit.law.limit, first.limit, 1e-2);
  EXPECT_LT(fit.rms, 1e-4);
}

TEST(FirstFlow, AFreshLayerStartsAtASteeperSlopeThanItStopsAt) {
  demvof::LayerSettings s = small_layer();
  demvof::ContactLaw rough = s.law;
  rough.bead_friction = 1.0;
  rough.rolling_friction = 0.2;
  const demvof::FirstFlow flow = demvof::first_flow(s, rough);
  ASSERT_TRUE(flow.started_at.has_value());
  EXPECT_GT(*flow.started_at, 16.5);
  EXPECT_LT(*flow.started_at, 32.0);  // a box of 6 diameters holds its layer: 27
  ASSERT_GE(flow.points.size(), 5U);
  ASSERT_EQ(flow.points.size(), flow.strain.size());
  EXPECT_GE(flow.strain.back(), demvof::largest_strain);
  EXPECT_GE(flow.points.back().friction.inertial_number, 0.6);
  for (std::size_t p = 0; p < flow.points.size(); ++p) {
    if (flow.strain[p] < demvof::least_strain || flow.strain[p] > demvof::largest_strain) continue;
    EXPECT_GT(flow.points[p].friction.friction, 0.3);
    EXPECT_LT(flow.points[p].friction.friction, 0.5);
  }
}

TEST(Material, ACaseTakesTheFileOverWithBase) {
  const granvof::test::TemporaryDirectory directory;
  const granvof::Scene scene = demvof::test::small();
  const demvof::ElementTests tests = made_up();
  std::ofstream(directory.path() / "small.toml") << granvof::test::small_case;
  std::ofstream(directory.path() / "material.toml") << demvof::material_text(scene, tests);
  std::ofstream(directory.path() / "last.toml")
      << "base = [\"small.toml\", \"material.toml\"]\n[scene]\nname = \"last\"\n[model]\npreset = "
         "\"sourced\"\n";
  const granvof::Scene last = granvof::load_scene(directory.path() / "last.toml", {});
  EXPECT_DOUBLE_EQ(last.solid.friction, 0.35);  // of first strain
  EXPECT_DOUBLE_EQ(last.contact.fast_friction, 0.7);
  EXPECT_DOUBLE_EQ(last.contact.inertial_number, 0.4);
  const double least = demvof::touching_fraction(scene.contact, 0.586, 100.0);
  EXPECT_NEAR(last.contact.solid_fraction_min, least, 5e-5);
  EXPECT_NEAR(last.contact.critical_solid_fraction, demvof::touching_fraction(scene.contact, 0.59, 80.0),
              5e-5);
  EXPECT_NEAR(last.contact.solid_fraction_max - last.contact.solid_fraction_min, 0.06, 1e-4);
  EXPECT_NEAR(last.contact.dense_solid_fraction - last.contact.solid_fraction_min, 0.03, 1e-4);
}

TEST(PackingAtRest, FrictionKeepsALayerLoose) {
  const demvof::LayerSettings s = small_layer();
  demvof::ContactLaw rough = s.law, smooth = s.law;
  rough.bead_friction = 1.0;
  rough.rolling_friction = 0.2;
  smooth.bead_friction = 0.0;
  const demvof::PackingAtRest loose = demvof::packing_at_rest(s, rough, 2);
  const demvof::PackingAtRest dense = demvof::packing_at_rest(s, smooth, 2);
  EXPECT_NEAR(loose.solid_fraction.value, 0.585, 0.02);
  EXPECT_NEAR(dense.solid_fraction.value, 0.63, 0.02);
  EXPECT_GT(dense.solid_fraction.value, loose.solid_fraction.value + 0.02);
  EXPECT_NEAR(loose.load, 0.585 * 2500.0 * 9.81 * 5e-3, 0.3 * loose.load);
}

// Beads that cannot roll freely, pressed into a layer, slide: little friction of theirs is that of the layer.
TEST(WallFriction, OfSlipperyWallsIsThatOfTheirContacts) {
  demvof::LayerSettings s = small_layer();
  s.law.wall_friction = 0.05;
  const demvof::Measured slippery = demvof::wall_friction(s);
  EXPECT_NEAR(slippery.value, 0.05, 0.01);
  s.law.wall_friction = 0.2;
  const demvof::Measured rough = demvof::wall_friction(s);
  EXPECT_GT(rough.value, 0.08);
  EXPECT_LE(rough.value, 0.2 + rough.band);
}

TEST(Cooling, OfSmoothBeadsFindsTheirRestitution) {
  demvof::LayerSettings s = small_layer();
  s.length = s.depth = 8.0;
  s.law.bead_friction = 0.0;
  for (const double restitution : {0.9, 0.7}) {
    s.law.restitution = restitution;
    const demvof::Measured found = demvof::cooling_restitution(s);
    EXPECT_NEAR(found.value, restitution, 0.02 + found.band);
    EXPECT_LT(found.band, 0.04);
  }
  s.law.restitution = 0.9;
  s.law.bead_friction = 0.4;
  EXPECT_LT(demvof::cooling_restitution(s).value, 0.85);  // friction takes its share
}
