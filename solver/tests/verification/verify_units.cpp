// A scene in other units of mass, length and time takes the same steps to the same dimensionless state: no
// threshold, floor or default of the solver has a unit of its own.
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "solver/tests/verification/restatement.hpp"

namespace granvof::test {
namespace {

struct Restated {
  const char* name;
  const char* scene;
  std::vector<std::string> set;
  double end;  // in the bed's column times
};

// gtest prints it by this.
void PrintTo(const Restated& r, std::ostream* out) {
  *out << r.name;
}

const std::vector<std::string> all_choices{
    "numerics.solid_flux=compressive",  "numerics.bed_surface=part-cells", "model.shear_dilatancy=true",
    "model.friction_law=inertial",      "model.thin_layer_arrest=true",    "model.agitation_drag=true",
    "model.frictional_restitution=true"};

std::vector<std::string> with_all_choices(std::vector<std::string> set) {
  set.insert(set.end(), all_choices.begin(), all_choices.end());
  return set;
}

// A bed that comes to rest on water: at the usual tolerances what the pressure step leaves is 2e-5 of the
// little that still moves.
const std::vector<std::string> tightly_solved{"grid.dx=0.005", "numerics.volume_tolerance=1e-9",
                                              "numerics.linear_tolerance=1e-6"};

class Units : public ::testing::TestWithParam<Restated> {
 protected:
  struct Differences {
    Difference motion, stress;
  };
  // After the same steps.
  Differences differences_in(const UnitFactors& factors) {
    const Restated& r = GetParam();
    const Scene scene = shipped_scene(r.scene, r.set);
    Simulation a(scene), b(restated(scene, factors));
    const double end = r.end * scales_of(scene).time();
    a.until(end);
    if (HasFatalFailure()) return {};
    b.until(end * factors.time);
    if (HasFatalFailure()) return {};
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.refused, b.refused);
    EXPECT_GT(a.fastest(a.now.u_c), 0.0);
    report("steps", a.steps);
    return {difference_of_motion(scene, a.now, b.now, factors), difference_of_stress(a.now, b.now, factors)};
  }
  static std::string text(const Difference& d, const UnitFactors& factors) {
    return fmt::format("{}: mass x {:.4g}, length x {}, time x {}", d.field, factors.mass, factors.length,
                       factors.time);
  }
};

// Powers of two that are sixth powers too: no square or cube root rounds otherwise than in SI units. But
// below the smallest normal number doubles lose bits, each unit others: alpha ahead of an interface falls
// that low.
TEST_P(Units, PowersOfTwoChangeNoBit) {
  for (const UnitFactors& factors :
       {UnitFactors{64.0, 1.0, 1.0}, {1.0, 1.0 / 64.0, 1.0}, {1.0, 1.0, 4096.0}}) {
    const Differences d = differences_in(factors);
    constexpr double smallest_normal = std::numeric_limits<double>::min();
    EXPECT_LT(d.motion.value, smallest_normal) << text(d.motion, factors);
    EXPECT_LT(d.stress.value, smallest_normal) << text(d.stress, factors);
  }
}

// Other factors round otherwise, and what the solvers leave differs: the pressure step leaves P_s to
// volume_tolerance times ten loads of the bed, friction velocities to 1e-6 of what a step changes, of whose
// differences Theta lives.
TEST_P(Units, OtherUnitsChangeNothing) {
  for (const UnitFactors& factors : {UnitFactors{1.0 / 150.0, 1.0, 1.0},
                                     {1.0, 0.01, 1.0},
                                     {1.0, 1.0, 1000.0},
                                     {1.0 / 150.0, 0.01, 1000.0}}) {
    const Differences d = differences_in(factors);
    report("motion", d.motion.value);
    report("stress", d.stress.value);
    EXPECT_LT(d.motion.value, 1e-6) << text(d.motion, factors);
    EXPECT_LT(d.stress.value, 1e-5) << text(d.stress, factors);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Units,
    ::testing::Values(
        Restated{"s1", "s1", {"grid.dx=0.01", "grid.dy=0.01"}, 2.0},
        Restated{"s1_all_choices", "s1", with_all_choices({"grid.dx=0.01", "grid.dy=0.01"}), 2.0},
        Restated{"heap", "heap", {"grid.dx=0.01", "grid.dy=0.01"}, 2.0},
        Restated{"heap_all_choices", "heap", with_all_choices({"grid.dx=0.01", "grid.dy=0.01"}), 2.0},
        Restated{"float_full", "float-full-r04", {"grid.dx=0.005"}, 2.0},
        Restated{"float_full_all_choices", "float-full-r04", with_all_choices(tightly_solved), 2.0},
        Restated{"dry_column", "dry-column", {"grid.dx=0.01", "grid.dy=0.01"}, 2.0},
        Restated{"dry_column_all_choices", "dry-column", with_all_choices({"grid.dx=0.01", "grid.dy=0.01"}),
                 2.0},
        Restated{"coulomb_walls",
                 "s1",
                 {"grid.dx=0.01", "walls.bottom.solid=coulomb", "walls.bottom.solid_friction=0.2"},
                 2.0},
        Restated{"viscous_liquid",
                 "s1",
                 {"grid.dx=0.01", "liquid.viscosity=1", "numerics.interface_scheme=plic"},
                 2.0},
        Restated{"explicit_contact", "s1", {"grid.dx=0.01", "numerics.contact_pressure=explicit"}, 0.2},
        Restated{"weightless_shear",
                 "s1",
                 {"grid.dx=0.01", "tank.gravity=0", "gate=false", "reference=false", "time.unit=s",
                  "walls.bottom.velocity=[0.5, 0.0]"},
                 0.5}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace granvof::test
