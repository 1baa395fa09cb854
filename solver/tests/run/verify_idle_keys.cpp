// "It has no effect without ..." is said where it is so, and nowhere else: every choice of the model and of
// the numerics and every parameter of the contacts is changed in scenes of which one part is off, and two
// runs are compared to the bit. The keys are those that are declared: a new one is tried by itself.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/scene/case_error.hpp"
#include "solver/tests/run/key_changes.hpp"
#include "solver/tests/simulation.hpp"

namespace granvof::test {
namespace {

// All fields after some steps, as bytes; none where a step collapses.
std::optional<std::string> outcome(const Scene& scene) {
  TimeLoop loop(scene);
  while (loop.now().time < until_all_work)
    if (loop.advance()) return std::nullopt;
  std::string bytes;
  for_each_field(loop.grid(), loop.now(), [&](const FieldOfState&, const Field& field) {
    bytes.append(reinterpret_cast<const char*>(field.data()), sizeof(double) * loop.grid().cells.size);
  });
  return bytes;
}

TEST(IdleKeys, AreThoseThatChangeNothing) {
  std::vector<Change> states = changes_at_work();
  std::erase_if(states, [](const Change& c) { return c.key.starts_with("contact."); });
  states.insert(states.begin(), {"", "model.preset=paper"});
  states.push_back({"", "liquid=false"});
  std::map<std::string, bool> acts;  // in any of the scenes
  std::map<std::string, std::vector<std::string>> silent;
  int compared = 0;
  for (const Change& state : states) {
    std::vector<std::string> sets{state.set};
    const Scene before = scene_at_work(sets);
    const auto usual = outcome(before);
    if (!usual) continue;
    for (const Change& change : changes_at_work()) {
      if (change.key == state.key) continue;
      std::vector<std::string> both = sets;
      both.push_back(change.set);
      std::optional<Scene> after;
      try {
        after = scene_at_work(both);
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
  for (const Change& change : changes_at_work())
    EXPECT_TRUE(acts[change.key]) << change.set << " acts in none of the scenes";
}

}  // namespace
}  // namespace granvof::test
