#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "solver/output/extract.hpp"
#include "solver/output/extract_motion.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;
using namespace granvof::scalar;

namespace {

TEST(Speeds, ArePickedByThePhasePresent) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fields.u_s[0][0] = 9.0;  // no grains there
  fields.f_s[3] = 0.05;
  fields.u_s[0][3] = 8.0;  // nor, to speak of, there
  EXPECT_FALSE(u_s_max(fields, scene));
  EXPECT_FALSE(u_s_dense_max(fields, scene));
  EXPECT_FALSE(u_liquid_max(fields, scene));
  fields.f_s[1] = 0.1;
  fields.u_s[0][1] = 3.0;
  fields.u_s[1][1] = -4.0;
  fields.f_s[2] = 0.6;
  fields.u_s[0][2] = 1.0;
  EXPECT_DOUBLE_EQ(*u_s_max(fields, scene), 5.0);
  EXPECT_DOUBLE_EQ(*u_s_dense_max(fields, scene), 1.0);
  fields.u_c[1][5] = -7.0;  // gas
  fields.alpha[6] = 1.0;
  fields.u_c[0][6] = 2.0;
  EXPECT_DOUBLE_EQ(*u_c_max(fields, scene), 7.0);
  EXPECT_DOUBLE_EQ(*u_liquid_max(fields, scene), 2.0);
}

// Grains are there from a tenth of 0.57 on, liquid where it has more than half of the cell.
TEST(Speeds, CountFromTheirThresholdsOn) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fields.f_s[1] = 0.1 * 0.57;
  fields.u_s[0][1] = 3.0;
  EXPECT_DOUBLE_EQ(*u_s_max(fields, scene), 3.0);
  fields.alpha[6] = 0.5;
  fields.u_c[0][6] = 2.0;
  EXPECT_FALSE(u_liquid_max(fields, scene));
  fields.alpha[6] = 0.51;
  EXPECT_DOUBLE_EQ(*u_liquid_max(fields, scene), 2.0);
}

TEST(Speeds, In3DHaveThreeComponents) {
  const auto scene = small_scene_3d();
  auto fields = empty_fields(scene);
  fields.u_c[0][3] = 1.0;
  fields.u_c[1][3] = 2.0;
  fields.u_c[2][3] = 2.0;
  EXPECT_DOUBLE_EQ(*u_c_max(fields, scene), 3.0);
}

TEST(Energies, OfEachPhase) {
  const auto scene = small_scene();  // cells of 1e-4 m3, g = 10
  auto fields = empty_fields(scene);
  const auto c = cell_index(fields, 2, 3, 0);  // y = 0.07
  fill(fields, fields.alpha, {0, 8}, {0, 5}, 0.0);
  fields.f_s[c] = 0.5;
  fields.alpha[c] = 0.6;
  fields.u_s[0][c] = 2.0;
  fields.u_c[1][c] = 3.0;
  EXPECT_NEAR(*kinetic_energy_solid(fields, scene), 0.5 * 2500.0 * 0.5 * 4.0 * 1e-4, 1e-14);
  EXPECT_NEAR(*kinetic_energy_liquid(fields, scene), 0.5 * 1000.0 * 0.3 * 9.0 * 1e-4, 1e-14);
  EXPECT_NEAR(*kinetic_energy_gas(fields, scene), 0.5 * 1.0 * 0.2 * 9.0 * 1e-4, 1e-16);
  EXPECT_NEAR(*potential_energy_solid(fields, scene), 2500.0 * 0.5 * 10.0 * 0.07 * 1e-4, 1e-14);
  EXPECT_NEAR(*potential_energy_liquid(fields, scene), 1000.0 * 0.3 * 10.0 * 0.07 * 1e-4, 1e-14);
  // Gas: all the tank (centre at 0.05 m) but 0.8 of that cell.
  EXPECT_NEAR(*potential_energy_gas(fields, scene), 10.0 * (0.05 * 40 - 0.07 * 0.8) * 1e-4, 1e-14);
}

// Gravity of an inclined tank acts along the floor too: g (sin, -cos) of 30 degrees.
TEST(Energies, OfATiltedTankFallAlongItsFloor) {
  auto scene = small_scene();
  scene.inclination = 30.0;
  auto fields = empty_fields(scene);
  fields.f_s[cell_index(fields, 2, 3, 0)] = 0.5;  // x = 0.125, y = 0.07
  const double weight = 2500.0 * 0.5 * 10.0 * 1e-4;
  EXPECT_NEAR(*potential_energy_solid(fields, scene),
              weight * (0.07 * std::cos(std::numbers::pi / 6.0) - 0.125 * 0.5), 1e-13);
}

TEST(ExtractScalars, GivesAValuePerEntryInTheOrderOfTheTable) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fill(fields, fields.f_s, {0, 3}, {0, 2}, 0.6);
  const auto scalars = extract_scalars(fields, scene);
  const auto table = scalar_table();
  ASSERT_EQ(scalars.size(), table.size());
  for (std::size_t e = 0; e < table.size(); ++e) EXPECT_EQ(scalars[e], table[e].function(fields, scene));
}

TEST(ExtractScalars, NamesAreUniqueAndFitForACsvHeader) {
  std::set<std::string_view> names;
  for (const auto& entry : scalar_table()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos)
        << entry.name;
    EXPECT_FALSE(entry.unit.empty());
    EXPECT_FALSE(entry.description.empty());
  }
}

TEST(ExtractScalars, RefusesValuesThatAreNotFinite) {
  const auto scene = small_scene();
  const auto expect_refused = [&](auto change, const std::string& field) {
    auto fields = empty_fields(scene);
    fields.time = 0.25;
    change(fields);
    const auto text = message_of<std::domain_error>([&] { extract_scalars(fields, scene); });
    EXPECT_NE(text.find(field + " is"), std::string::npos) << text;
    EXPECT_NE(text.find("(2, 1, 0)"), std::string::npos) << text;
    EXPECT_NE(text.find("0.25"), std::string::npos) << text;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expect_refused([](CellFields& f) { f.f_s[10] = nan; }, "f_s");
  expect_refused([](CellFields& f) { f.alpha[10] = nan; }, "alpha");
  expect_refused([](CellFields& f) { f.p_c[10] = infinity; }, "p_c");
  expect_refused([](CellFields& f) { f.theta[10] = nan; }, "theta");
  expect_refused([](CellFields& f) { f.phi[10] = nan; }, "phi");
  expect_refused([](CellFields& f) { f.u_s[1][10] = nan; }, "u_s");
  expect_refused([](CellFields& f) { f.u_c[0][10] = -infinity; }, "u_c");
  expect_refused([](CellFields& f) { (f.p_s = f.p_c)[10] = nan; }, "p_s");
}

TEST(ExtractScalars, RefusesArraysAndGridsThatDoNotFit) {
  const auto scene = small_scene();
  auto fields = empty_fields(scene);
  fields.phi.pop_back();
  EXPECT_NE(message_of<std::invalid_argument>([&] { extract_scalars(fields, scene); }).find("phi"),
            std::string::npos);
  fields = empty_fields(scene);
  fields.spacing[0] *= 2.0;
  EXPECT_NE(message_of<std::invalid_argument>([&] { extract_scalars(fields, scene); }).find("0.8 m"),
            std::string::npos);
}

}  // namespace
