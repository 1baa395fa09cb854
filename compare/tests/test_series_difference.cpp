// Two runs that must be one: whose rows are compared, and in what.
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "compare/metrics/series_difference.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/restate.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

Scene column() {
  return load_scene(cases_directory() / "invariance/column.toml");
}

// Rows at these times [s], with a front and a volume that grow with it.
Series series(const std::vector<double>& times, double length = 1.0, double volume = 1.0) {
  Series made;
  made.columns = {
      {"time", "s", ""}, {"linear", "-", ""}, {"front_dense", "m", ""}, {"solid_volume", "m3", ""}};
  for (const double t : times)
    made.rows.push_back({t, 10.0 * length, length * (0.1 + t), volume * (0.002 + t)});
  return made;
}

TEST(SeriesDifference, IsOverTheScenesScales) {
  const Scene scene = column();
  Series a = series({0.0, 0.1, 0.2}), b = a;
  EXPECT_EQ(series_difference(a, scene, b, scene).value().largest, 0.0);
  b.rows[1][2] = *b.rows[1][2] + 0.01;
  b.rows[1][1] = 12.0;  // what the solver took is no result
  const SeriesDifference found = series_difference(a, scene, b, scene).value();
  EXPECT_NEAR(found.largest, 0.01 / scales_of(scene).length, 1e-14);
  EXPECT_EQ(found.column, "front_dense");
  EXPECT_NEAR(found.time, 0.1 / scales_of(scene).time(), 1e-12);
  b.rows[1][2].reset();
  EXPECT_TRUE(std::isinf(series_difference(a, scene, b, scene).value().largest));
}

TEST(SeriesDifference, ComparesTheRowsOfTheSparserOne) {
  const Scene scene = column();
  const Series few = series({0.0, 0.2}), many = series({0.0, 0.1, 0.2});
  EXPECT_EQ(series_difference(few, scene, many, scene).value().largest, 0.0);
  EXPECT_EQ(series_difference(many, scene, few, scene).value().largest, 0.0);
  EXPECT_FALSE(series_difference(series({0.0, 0.15}), scene, many, scene));
  EXPECT_FALSE(series_difference(series({}), scene, many, scene));
  Series other = many;
  other.columns[2].unit = "mm";
  EXPECT_FALSE(series_difference(few, scene, other, scene));
}

TEST(SeriesDifference, NeitherUnitsNorDepthCount) {
  const Scene scene = column();
  const Scene other = parse_scene(restated_case(scene, {1.0, 0.25, 1.0}), "column");
  Scene deep = scene;
  deep.tank[2] *= 4.0;
  const Series a = series({0.0, 0.1});
  EXPECT_LT(series_difference(a, scene, series({0.0, 0.1}, 0.25, 1.0 / 64.0), other).value().largest, 1e-14);
  EXPECT_LT(series_difference(a, scene, series({0.0, 0.1}, 1.0, 4.0), deep).value().largest, 1e-14);
  EXPECT_GT(series_difference(a, scene, series({0.0, 0.1}, 1.0, 4.0), scene).value().largest, 1.0);
}

TEST(SeriesDifference, AColumnOfAnUnknownUnitIsAnError) {
  const Scene scene = column();
  Series a = series({0.0});
  a.columns[2].unit = "furlong";
  EXPECT_THROW(series_difference(a, scene, a, scene), std::out_of_range);
}

}  // namespace
}  // namespace granvof::compare
