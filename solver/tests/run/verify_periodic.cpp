// A periodic direction has no first column: a state shifted along it, its ends joined, must run to the
// shifted result.
//
// The shift is by half the cells of a direction that has a power of two of them: multigrid then pairs the
// same cells in both runs, so that what its single precision leaves is the same too and the comparison is one
// to rounding. What lies on the seam in one run lies in the middle of the tank in the other. Every step
// starts from the same state: sums in another order change the last digit, which an iteration that is stopped
// at its tolerance turns into more (the friction solve of a bed that locks: 1e-8 of the velocity). For the
// same reason the tolerances are tight, and friction is regularised at a shear that the bed has.
#include <cmath>
#include <numbers>

#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using test::name_of;
using test::Simulation;
using test::Variant;

constexpr int steps = 12;
// Of the largest value of a field. The one solve of explicit contacts ends at the tolerance, where Newton's
// last one overshoots, and a tolerance near rounding refuses a step in one run and not in the other.
double agreement_in(const Scene& scene) {
  return scene.numerics.contact_pressure == ContactPressure::explicit_ ? 1e-7 : 1e-10;
}

// Half a tank of liquid, in it a bed narrower than the tank that begins at the seam and reaches out of the
// liquid; the floor is rough and moves.
Scene scene_2d(const std::vector<std::string>& overrides) {
  return parse_scene(R"([scene]
name = "seam"
[tank]
size = [0.16, 0.12]
[grid]
dx = 0.01
[walls]
all = "no-slip"
left = "periodic"
right = "periodic"
bottom = { velocity = [0.05, 0.0] }
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.045
[solid]
density = 2500
diameter = 2e-3
friction = 0.4
[bed]
length = 0.07
height = 0.065
solid_fraction = 0.585
[time]
end = 1
[numerics]
dt_max = 2e-3
volume_tolerance = 1e-12
linear_tolerance = 1e-8
[contact]
regularisation = 1e-3
[model]
preset = "paper"
)",
                     "seam", overrides);
}

Scene scene_3d(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"scene.dimensions=3",
                               "tank.size=[0.08, 0.06, 0.08]",
                               "walls.front=periodic",
                               "walls.back=periodic",
                               "liquid.level=0.025",
                               "bed.length=0.035",
                               "bed.height=0.035",
                               "bed.width=0.045",
                               "walls.bottom.velocity=[0.05, 0.0, 0.02]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return scene_2d(all);
}

// Motion, heat and pressure that vary along every direction and are as smooth across the seam as elsewhere.
void disturb(Simulation& run) {
  const Layout& l = run.grid.cells;
  const auto wave = [&](int i, int j, int k, double phase) {
    const double turn = 2.0 * std::numbers::pi;
    const double x = turn * i / l.n[0], y = turn * j / l.n[1], z = turn * k / l.n[2];
    return std::sin(x + phase) + 0.5 * std::sin(2.0 * x + y + phase * phase) +
           0.4 * std::cos(z + 3.0 * phase);
  };
  State& s = run.now;
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) {
        const std::ptrdiff_t c = l.index(i, j, k);
        s.theta[c] = 1e-4 * (2.0 + wave(i, j, k, 0.7));
        s.p_c[c] += 10.0 * wave(i, j, k, 0.3);
      }
  for (int d = 0; d < run.grid.dim; ++d) {
    const Range r = run.grid.inner_faces(d);
    for (int k = r.lower[2]; k < r.upper[2]; ++k)
      for (int j = r.lower[1]; j < r.upper[1]; ++j)
        for (int i = r.lower[0]; i < r.upper[0]; ++i) {
          const std::ptrdiff_t c = l.index(i, j, k);
          s.u_c[d][c] = 0.05 * wave(i, j, k, 1.0 + d);
          s.u_s[d][c] = s.u_strain[d][c] = 0.04 * wave(i, j, k, 2.0 + d);
        }
  }
  run.fill_ghosts();
}

// shifted(cell + half the cells of `along`) = given(cell)
void shift(const Layout& l, int along, const Field& given, Field& shifted) {
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1] + (l.periodic[1] ? 0 : 1); ++j)
      for (int i = 0; i < l.n[0] + (l.periodic[0] ? 0 : 1); ++i) {
        std::array<int, 3> to{i, j, k};
        to[along] = (to[along] + l.n[along] / 2) % l.n[along];
        shifted[l.index(to[0], to[1], to[2])] = given[l.index(i, j, k)];
      }
}

void set_shifted(const Simulation& from, int along, Simulation& to) {
  const Layout& l = from.grid.cells;
  to.now = from.now;
  const auto pass = [&](const Field& a, Field& b) { shift(l, along, a, b); };
  pass(from.now.f_s, to.now.f_s);
  pass(from.now.alpha, to.now.alpha);
  pass(from.now.p_c, to.now.p_c);
  pass(from.now.p_s, to.now.p_s);
  pass(from.now.theta, to.now.theta);
  pass(from.now.phi, to.now.phi);
  pass(from.now.packing, to.now.packing);
  for (int d = 0; d < from.grid.dim; ++d) {
    pass(from.now.u_s[d], to.now.u_s[d]);
    pass(from.now.u_c[d], to.now.u_c[d]);
    pass(from.now.u_strain[d], to.now.u_strain[d]);
  }
  to.fill_ghosts();
}

struct Difference {
  double largest = 0.0;  // over the field's own largest value, of the worst field
  std::string where;     // its name and the place in the run that was not shifted
};

Difference difference(const Simulation& given, const Simulation& shifted, int along) {
  const Grid& grid = given.grid;
  Difference worst;
  const auto compare = [&](const std::string& name, const Field& a, const Field& b, Range r) {
    const double* v = a.data();
    const double scale = max_over(grid.cells, r, 0.0, [=](std::ptrdiff_t c) { return std::fabs(v[c]); });
    Field moved(grid);
    shift(grid.cells, along, a, moved);
    for (int k = r.lower[2]; k < r.upper[2]; ++k)
      for (int j = r.lower[1]; j < r.upper[1]; ++j)
        for (int i = r.lower[0]; i < r.upper[0]; ++i) {
          const std::ptrdiff_t c = grid.cells.index(i, j, k);
          const double off = std::fabs(moved[c] - b[c]) / (scale > 0.0 ? scale : 1.0);
          if (off > worst.largest)
            worst = {off, name + " at " + std::to_string(i) + ' ' + std::to_string(j) + ' ' +
                              std::to_string(k) + " of the shifted run"};
        }
  };
  const State &a = given.now, &b = shifted.now;
  compare("f_s", a.f_s, b.f_s, grid.all_cells());
  compare("alpha", a.alpha, b.alpha, grid.all_cells());
  compare("p_c", a.p_c, b.p_c, grid.all_cells());
  compare("p_s", a.p_s, b.p_s, grid.all_cells());
  compare("theta", a.theta, b.theta, grid.all_cells());
  compare("phi", a.phi, b.phi, grid.all_cells());
  compare("packing", a.packing, b.packing, grid.all_cells());
  for (int d = 0; d < grid.dim; ++d) {
    const std::string axis(1, "xyz"[d]);
    compare("u_s_" + axis, a.u_s[d], b.u_s[d], grid.inner_faces(d));
    compare("u_c_" + axis, a.u_c[d], b.u_c[d], grid.fluid_faces(d));
  }
  return worst;
}

// `moved` is the scene with everything that is not part of the state shifted.
void expect_shift_invariant(const Scene& scene, const Scene& moved, int along) {
  Simulation given(scene), shifted(moved);
  disturb(given);
  set_shifted(given, along, shifted);
  ASSERT_EQ(difference(given, shifted, along).largest, 0.0);
  double furthest = 0.0;
  for (int i = 0; i < steps; ++i) {
    given.advance();
    shifted.advance();
    if (::testing::Test::HasFatalFailure()) return;
    const Difference d = difference(given, shifted, along);
    EXPECT_LT(d.largest, agreement_in(scene)) << d.where << ", along "
                                              << "xyz"[along] << ", step " << i + 1;
    furthest = std::fmax(furthest, d.largest);
    set_shifted(given, along, shifted);
  }
  std::ostringstream text;
  text << furthest;
  ::testing::Test::RecordProperty(std::string("furthest_along_") + "xyz"[along], text.str());
  EXPECT_EQ(given.refused, shifted.refused);
  EXPECT_GT(given.fastest(given.now.u_s), 0.01);
}

// A layer that is the same along x and sheared from above: nothing comes to depend on x. Over the first
// steps, before a flow that is unstable makes something of rounding.
void expect_uniform_along_x(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"bed.length=0.16", "walls.top.velocity=[0.5, 0.0]",
                               "walls.bottom.velocity=[0.0, 0.0]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Simulation run(scene_2d(all));
  for (int i = 0; i < 4 * steps; ++i) {
    run.advance();
    if (::testing::Test::HasFatalFailure()) return;
  }
  const Layout& l = run.grid.cells;
  const auto expect_uniform = [&](const char* name, const Field& f, double least) {
    double largest = 0.0, apart = 0.0;
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) {
        largest = std::fmax(largest, std::fabs(f[l.index(i, j, 0)]));
        apart = std::fmax(apart, std::fabs(f[l.index(i, j, 0)] - f[l.index(0, j, 0)]));
      }
    EXPECT_LT(apart, agreement_in(run.scene) * largest) << name;
    EXPECT_GT(largest, least) << name;
  };
  expect_uniform("theta", run.now.theta, 1e-9);
  expect_uniform("u_s_x", run.now.u_s[0], 1e-3);
  expect_uniform("f_s", run.now.f_s, 0.1);
}

TEST(Uniform, GrainsBetweenPlates) {
  expect_uniform_along_x(
      {"tank.gravity=0", "bed.height=0.12", "bed.solid_fraction=0.45", "liquid=false", "gas.density=1.2"});
}

TEST(Uniform, ABedWithAFreeSurface) {
  expect_uniform_along_x({"liquid=false", "bed.height=0.115", "gas.viscosity=1e-3"});
}

// A gate that rises on the seam, and in the middle of the tank.
TEST(Gate, OnTheSeamIsAGateAnywhere) {
  const auto scene = [](const std::string& position) {
    return scene_2d({"gate.speed=3", "gate.position=" + position});
  };
  expect_shift_invariant(scene("0.08"), scene("0.159"), 0);
}

class Seam : public ::testing::TestWithParam<Variant> {};

TEST_P(Seam, AShiftAlongXShiftsTheResult) {
  const Scene scene = scene_2d(GetParam().overrides);
  expect_shift_invariant(scene, scene, 0);
}

TEST_P(Seam, AShiftAlongXOrZShiftsTheResultIn3D) {
  const Scene scene = scene_3d(GetParam().overrides);
  for (const int along : {0, 2}) expect_shift_invariant(scene, scene, along);
}

INSTANTIATE_TEST_SUITE_P(
    Choices, Seam,
    ::testing::Values(
        Variant{"paper", {}}, Variant{"advised", {"model.preset=advised"}},
        Variant{"sourced", {"model.preset=sourced"}}, Variant{"open_top", {"walls.top=open"}},
        Variant{"limited_flux", {"numerics.solid_flux=limited"}},
        Variant{"compressive_flux", {"numerics.solid_flux=compressive"}},
        Variant{"part_cells", {"numerics.bed_surface=part-cells"}},
        Variant{"shear_dilatancy", {"model.shear_dilatancy=true"}},
        Variant{"inertial_friction", {"model.friction_law=inertial"}},
        Variant{"whole_stress_friction", {"model.friction_law=inertial", "model.whole_stress_friction=true"}},
        Variant{"thin_layer_arrest", {"model.thin_layer_arrest=true"}},
        Variant{"agitation_drag", {"model.agitation_drag=true"}},
        Variant{"frictional_restitution", {"model.frictional_restitution=true"}},
        Variant{"algebraic_temperature", {"model.granular_temperature=algebraic"}},
        Variant{"plic", {"numerics.interface_scheme=plic"}},
        Variant{"upwind_interface", {"numerics.interface_scheme=upwind"}},
        Variant{"coulomb_floor", {"walls.bottom.solid=coulomb", "walls.bottom.solid_friction=0.2"}},
        Variant{"slip", {"walls.all=slip", "walls.bottom.fluid=no-slip", "walls.bottom.solid=no-slip"}},
        Variant{"thick_liquid", {"liquid.viscosity=5"}}, Variant{"light_grains", {"solid.density=500"}},
        Variant{"explicit_contact",
                {"numerics.contact_pressure=explicit", "numerics.volume_tolerance=1e-13"}},
        Variant{
            "everything",
            {"numerics.solid_flux=limited", "numerics.bed_surface=part-cells", "model.friction_law=inertial",
             "model.thin_layer_arrest=true", "model.shear_dilatancy=true", "model.agitation_drag=true",
             "model.frictional_restitution=true", "numerics.interface_scheme=plic"}}),
    name_of);

}  // namespace
}  // namespace granvof
