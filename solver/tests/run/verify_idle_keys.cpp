// "It has no effect without ..." is said where it is so, and nowhere else: every choice of the model and of
// the numerics and every parameter of the contacts is changed in scenes of which one part is off, and two
// runs are compared to the bit. The keys are those that are declared: a new one is tried by itself.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/plausibility/plausibility.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/simulation.hpp"
#include "solver/tests/small_tank.hpp"

namespace granvof::test {
namespace {

using case_file::Key;

// A heap with its foot in water that runs down and out over a rough floor, with all that there is at work.
constexpr std::string_view all_at_work = R"([walls]
top = "open"
[bed]
length = 0.05
height = 0.035
slope = 60
solid_fraction = 0.59
colour = "layers"
colour_size = 0.01
[model]
preset = "paper"
packing = "carried"
friction_law = "inertial"
shear_dilatancy = true
critical_packing = "by-rate"
thin_layer_arrest = true
agitation_drag = true
frictional_restitution = true
correlated_collisions = true
viscous_contact_pressure = true
suspension_viscosity = true
[numerics]
bed_surface = "part-cells"
dt_max = 2e-3
)";
constexpr double until = 0.024;  // [s]: grains are agitated, and friction has felt it

struct Change {
  std::string key, set;
};

Scene scene_of(std::vector<std::string> sets) {
  sets.insert(sets.begin(), "solid.diameter=1.6e-3");
  return small_tank("work", "size = [0.12, 0.05]", 0.01, all_at_work, sets);
}

std::string text_of_key(const Scene& scene, const std::string& key) {
  const auto stated = case_file::read_case_text(scene.resolved, "resolved", {}).entries;
  const auto found = stated.find(key);
  return found == stated.end() ? "" : found->second.shown;
}

// All fields after some steps, as bytes; none where a step collapses.
std::optional<std::string> outcome(const Scene& scene) {
  TimeLoop loop(scene);
  while (loop.now().time < until)
    if (loop.advance()) return std::nullopt;
  std::string bytes;
  for_each_field(loop.grid(), loop.now(), [&](const FieldOfState&, const Field& field) {
    bytes.append(reinterpret_cast<const char*>(field.data()), sizeof(double) * loop.grid().cells.size);
  });
  return bytes;
}

std::vector<Change> changes() {
  std::vector<Change> all;
  const Scene base = scene_of({});
  for (const Key& key : case_file::keys()) {
    if (key.name == "model.preset") continue;
    const bool switches = key.table() == "model" || key.table() == "numerics";
    if (switches)
      for (const std::string& word : key.words)
        if (word != text_of_key(base, key.name))
          all.push_back({key.name, fmt::format("{}={}", key.name, word)});
    if (key.table() == "contact") {
      const double now = std::stod(text_of_key(base, key.name));
      all.push_back({key.name, fmt::format("{}={}", key.name, 0.995 * now)});
    }
  }
  return all;
}

std::string said_of(const std::string& key, const std::vector<const Scene*>& scenes) {
  for (const Scene* scene : scenes)
    for (const Implausible& finding : plausibility(*scene))
      if (finding.key == key && finding.usual != "") return finding.reason;
  return "";
}

TEST(IdleKeys, AreThoseThatChangeNothing) {
  std::vector<Change> states = changes();
  std::erase_if(states, [](const Change& c) { return c.key.starts_with("contact."); });
  states.insert(states.begin(), {"", "model.preset=paper"});
  states.push_back({"", "liquid=false"});
  std::map<std::string, bool> acts;  // in any of the scenes
  std::map<std::string, std::vector<std::string>> silent;
  int compared = 0;
  for (const Change& state : states) {
    std::vector<std::string> sets{state.set};
    const Scene before = scene_of(sets);
    const auto usual = outcome(before);
    if (!usual) continue;
    for (const Change& change : changes()) {
      if (change.key == state.key) continue;
      std::vector<std::string> both = sets;
      both.push_back(change.set);
      std::optional<Scene> after;
      try {
        after = scene_of(both);
      } catch (const CaseError&) {
        continue;
      }
      if (after->resolved == before.resolved) continue;
      const auto changed = outcome(*after);
      const bool same = changed == usual;
      const std::string said = said_of(change.key, {&before, &*after});
      ++compared;
      if (!same) acts[change.key] = true;
      if (said.starts_with("it has no effect")) {
        EXPECT_TRUE(same) << change.set << " with " << state.set << ": " << said;
      }
      if (same && said.empty())
        silent[change.key].push_back(fmt::format("{} with {}", change.set, state.set));
    }
  }
  EXPECT_GT(compared, 500);
  for (const auto& [key, where] : silent)
    for (const std::string& text : where)
      EXPECT_FALSE(acts[key]) << "nothing is said of it, and it has no effect: " << text;
  for (const Change& change : changes())
    EXPECT_TRUE(acts[change.key]) << change.set << " acts in none of the scenes";
}

}  // namespace
}  // namespace granvof::test
