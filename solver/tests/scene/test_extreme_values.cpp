// Every key that takes a number, with values that nobody means: refused, or named by a warning. The keys are
// those that are declared: a new one is tried by itself.
#include <algorithm>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "solver/plausibility/plausibility.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/keys.hpp"
#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

using case_file::Key;
using Sets = std::vector<std::string>;

const Sets deep{"scene.dimensions=3",  "tank.size=[0.4, 0.12, 0.04]", "reference=false",
                "walls.front=no-slip", "walls.back=no-slip",          "bed.width=0.02",
                "bed.z=0.01"};
const Sets obstacle{"obstacle.x0=[0.2]", "obstacle.x1=[0.25]", "obstacle.y0=[0.02]", "obstacle.y1=[0.04]"};
const Sets inlet{"walls.left.inflow=0.1", "walls.left.inflow_solid_fraction=0.1",
                 "walls.left.inflow_liquid_share=0.5", "bed.x=0.05", "gate=false"};
const Sets outlet{"walls.left.outflow_pressure=10", "walls.left.outflow_level=0.05"};
const Sets bumps{"walls.left.solid=bumpy", "walls.left.bumpiness=30", "walls.left.bump_restitution=0.8"};
const Sets shear{"model.shear_dilatancy=true", "model.critical_packing=by-rate"};
const Sets box{"liquid.box.origin=[0.2, 0.08]", "liquid.box.size=[0.1, 0.02]"};

Sets and_also(Sets sets, const Sets& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

// What a key needs beside it in the small case.
const std::map<std::string, Sets, std::less<>> needs{
    {"grid.dz", deep},
    {"bed.z", deep},
    {"bed.width", deep},
    {"obstacle.x0", obstacle},
    {"obstacle.x1", obstacle},
    {"obstacle.y0", obstacle},
    {"obstacle.y1", obstacle},
    {"obstacle.z0", and_also(and_also(deep, obstacle), {"obstacle.z0=[0.01]", "obstacle.z1=[0.02]"})},
    {"obstacle.z1", and_also(and_also(deep, obstacle), {"obstacle.z0=[0.01]", "obstacle.z1=[0.02]"})},
    {"walls.left.solid_friction", {"walls.left.solid=coulomb", "walls.left.solid_friction=0.3"}},
    {"walls.left.bumpiness", bumps},
    {"walls.left.bump_restitution", bumps},
    {"walls.left.velocity", {"walls.left.velocity=[0, 0.1]"}},
    {"walls.left.inflow", inlet},
    {"walls.left.inflow_solid_fraction", inlet},
    {"walls.left.inflow_liquid_share", inlet},
    {"walls.left.outflow_pressure", outlet},
    {"walls.left.outflow_level", outlet},
    {"liquid.box.origin", box},
    {"liquid.box.size", box},
    {"contact.fast_friction", {"model.friction_law=inertial"}},
    {"contact.inertial_number", {"model.friction_law=inertial"}},
    {"contact.viscous_number", {"model.friction_law=viscous"}},
    {"contact.stop_length", {"model.thin_layer_arrest=true"}},
    {"contact.critical_solid_fraction", shear},
    {"contact.dilatancy_slope", shear},
    {"contact.dilatancy_rate", shear},
    {"bed.solid_volume", {"bed.solid_volume=0.002565"}},
    {"bed.colour_size", {"bed.colour=layers", "bed.colour_size=0.01"}},
    {"time.hold", {"time.hold=0.1"}},
    {"output.field_interval", {"output.field_interval=1"}},
    {"output.checkpoint_interval", {"output.checkpoint_interval=60"}},
    {"reference.gate_friction", {"reference.gate_friction=0.3"}},
};

enum class Extreme { large, small, negative };
constexpr std::array extremes{Extreme::large, Extreme::small, Extreme::negative};
double number_of(Extreme extreme) {
  return extreme == Extreme::large ? 1e25 : extreme == Extreme::small ? 1e-25 : -1e25;
}

// What may be meant.
struct Meant {
  std::string key;
  Extreme extreme;
  std::string reason;
};
const std::vector<Meant> meant{
    {"tank.inclination", Extreme::small, "a level tank"},
    {"walls.left.velocity", Extreme::small, "a wall at rest"},
    {"walls.left.solid_friction", Extreme::small, "a slippery wall"},
    {"walls.left.outflow_pressure", Extreme::small, "that of the air"},
    {"liquid.box.origin", Extreme::small, "the tank's corner"},
    {"bed.x", Extreme::small, "the tank's end"},
    {"bed.y", Extreme::small, "the floor"},
    {"bed.z", Extreme::small, "the tank's side"},
    {"obstacle.y0", Extreme::small, "the floor"},
    {"obstacle.z0", Extreme::small, "the tank's side"},
    {"numerics.dt_min", Extreme::small, "no step is too short"},
    {"reference.poisson", Extreme::small, "cork"},
    {"reference.bead_friction", Extreme::small, "smooth beads"},
    {"reference.bead_rolling_friction", Extreme::small, "round beads"},
    {"reference.wall_friction", Extreme::small, "a smooth wall"},
    {"reference.gate_friction", Extreme::small, "a smooth plate"},
    {"reference.preparation_friction", Extreme::small, "the densest bed"},
    {"reference.preparation_rolling_friction", Extreme::small, "the densest bed"},
};
bool is_meant(const std::string& key, Extreme extreme) {
  return std::ranges::any_of(meant, [&](const Meant& m) { return m.key == key && m.extreme == extreme; });
}

bool takes_numbers(const Key& key) {
  return key.documented &&
         (key.type.find("number") != std::string::npos || key.type.find("integer") != std::string::npos);
}

// A list has the extreme in one place after another.
std::vector<std::string> values_of(const Key& key, const case_file::Value& usual, Extreme extreme) {
  const double x = number_of(extreme);
  const auto* list = std::get_if<std::vector<double>>(&usual);
  if (!list) return {fmt::format("{}={}", key.name, x)};
  std::vector<std::string> values;
  for (std::size_t i = 0; i < list->size(); ++i) {
    std::vector<double> changed = *list;
    changed[i] = x;
    values.push_back(fmt::format("{}=[{}]", key.name, fmt::join(changed, ", ")));
  }
  return values;
}

// The warning's key, or the table whose parts it means.
bool names(const Implausible& finding, const std::string& key) {
  return key == finding.key || key.starts_with(finding.key + ".");
}

struct Tried {
  Key key;
  Sets beside;
};
void PrintTo(const Tried& tried, std::ostream* out) {
  *out << tried.key.name;
}
std::vector<Tried> all_tried() {
  std::vector<Tried> all;
  for (const Key& key : case_file::keys()) {
    if (!takes_numbers(key)) continue;
    const auto found = needs.find(key.name);
    all.push_back({key, found == needs.end() ? Sets{} : found->second});
  }
  return all;
}

class ExtremeValues : public ::testing::TestWithParam<Tried> {};

TEST_P(ExtremeValues, AreRefusedOrNamed) {
  const auto& [key, beside] = GetParam();
  // The case itself has the key, and nothing is said of it: what is said is of the value.
  const Scene usual = small(beside);
  ASSERT_EQ(plausibility(usual).size(), 0U) << text_of(plausibility(usual).front());
  const auto stated = case_file::read_case_text(usual.resolved, "resolved", beside).entries;
  ASSERT_TRUE(stated.contains(key.name)) << "add what it needs to the table above";
  for (const Extreme extreme : extremes) {
    bool held = true;
    std::string said;
    for (const std::string& value : values_of(key, stated.at(key.name).value, extreme)) {
      try {
        const auto found = plausibility(small(and_also(beside, {value})));
        const bool named =
            std::ranges::any_of(found, [&](const Implausible& i) { return names(i, key.name); });
        held = held && named;
        if (!named) said += value + " ";
      } catch (const CaseError&) {
      }
    }
    EXPECT_NE(held, is_meant(key.name, extreme))
        << (held ? "it is held, and in the list of what may be meant: " : "it is taken without a word: ")
        << said;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtremeValues, ::testing::ValuesIn(all_tried()), [](const auto& i) {
  std::string name = i.param.key.name;
  std::ranges::replace(name, '.', '_');
  return name;
});

}  // namespace
}  // namespace granvof::test
