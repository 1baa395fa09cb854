// A scene with all that there is at work, and every change of a choice of its model and numerics.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "solver/plausibility/plausibility.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/small_tank.hpp"

namespace granvof::test {

// A heap with its foot in water that runs down and out over a rough floor, with all that there is at work.
inline constexpr std::string_view all_at_work = R"([walls]
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
whole_stress_friction = true
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
inline constexpr double until_all_work = 0.024;  // [s]: grains are agitated, and friction has felt it

struct Change {
  std::string key, set;
};

inline Scene scene_at_work(std::vector<std::string> sets) {
  sets.insert(sets.begin(), "solid.diameter=1.6e-3");
  return small_tank("work", "size = [0.12, 0.05]", 0.01, all_at_work, sets);
}

inline std::string text_of_key(const Scene& scene, const std::string& key) {
  const auto stated = case_file::read_case_text(scene.resolved, "resolved", {}).entries;
  const auto found = stated.find(key);
  return found == stated.end() ? "" : found->second.shown;
}

// Each word that a choice of the model and of the numerics may have beside its own, and each parameter of the
// contacts a little off. The keys are those that are declared: a new one is tried by itself.
inline std::vector<Change> changes_at_work() {
  std::vector<Change> all;
  const Scene base = scene_at_work({});
  for (const case_file::Key& key : case_file::keys()) {
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

// What the program says of a key in the first of the scenes that it finds it odd in; empty: nothing.
inline std::string said_of(const std::string& key, const std::vector<const Scene*>& scenes) {
  for (const Scene* scene : scenes)
    for (const Implausible& finding : plausibility(*scene))
      if (finding.key == key && finding.usual != "") return finding.reason;
  return "";
}

}  // namespace granvof::test
