#include <gtest/gtest.h>

#include "compare/metrics/flow_section.hpp"

namespace granvof::compare {
namespace {

constexpr double g = 9.81, density = 1000.0, viscosity = 0.5;

Scene inclined() {
  Scene s;
  s.gravity = g;
  s.inclination = 30.0;
  s.liquid = {density, viscosity};
  return s;
}

// Three columns of six cells 2 mm high; 9 mm of liquid.
CellFields film() {
  CellFields f;
  f.cells = {3, 6, 1};
  f.spacing = {0.01, 0.002, 1.0};
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 3; ++i) {
      const double y = (j + 0.5) * 0.002;
      f.alpha.push_back(j < 4 ? 1.0 : j == 4 ? 0.5 : 0.0);
      f.u_c[0].push_back(density * 0.5 * g / viscosity * (0.009 * y - 0.5 * y * y));
    }
  return f;
}

TEST(FilmDistance, IsZeroForNusseltsFilmAndOfTheLiquidAlone) {
  const Scene s = inclined();
  CellFields f = film();
  EXPECT_NEAR(liquid_depth_in_the_middle(f), 0.009, 1e-15);
  EXPECT_NEAR(film_distance(f, s).value(), 0.0, 1e-12);
  f.u_c[0][3 * 4 + 1] = 9.0;  // the cell of the surface
  f.u_c[0][3 * 2 + 0] = 9.0;  // another column
  EXPECT_NEAR(film_distance(f, s).value(), 0.0, 1e-12);
  f.u_c[0][3 * 2 + 1] *= 1.2;  // the fastest that counts
  EXPECT_NEAR(film_distance(f, s).value(), 0.2, 1e-9);
  f.alpha.assign(18, 0.5);
  EXPECT_FALSE(film_distance(f, s));
}

TEST(ReattachmentLength, IsWhereTheFlowAlongTheFloorTurns) {
  Scene s;
  s.obstacles = {{{0.0, 0.0, 0.0}, {0.02, 0.01, 1.0}}};
  CellFields f;
  f.cells = {8, 1, 1};
  f.spacing = {0.01, 0.01, 1.0};
  f.u_c[0] = {0.0, 0.0, -1.0, -2.0, -1.0, 3.0, 2.0, 2.0};
  // between the centres at 45 and 55 mm, a quarter of the way: 27.5 mm behind the step of 10 mm
  EXPECT_NEAR(reattachment_length(f, s).value(), 2.75, 1e-12);
  f.u_c[0] = {0.0, 0.0, 1.0, 2.0, 1.0, 3.0, 2.0, 2.0};
  EXPECT_FALSE(reattachment_length(f, s));
  f.u_c[0] = {-1.0, 1.0, 1.0, 2.0, 1.0, 3.0, 2.0, 2.0};  // before the step
  EXPECT_FALSE(reattachment_length(f, s));
  s.obstacles.clear();
  EXPECT_FALSE(reattachment_length(f, s));
}

}  // namespace
}  // namespace granvof::compare
