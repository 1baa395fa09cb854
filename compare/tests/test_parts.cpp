// The parts of the model that ablate takes out or puts in, for a scene of any preset.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compare/study/ablate.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/presets.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

const std::vector<Part> parts{{"no LES", {"model.les=false"}, std::nullopt, ""},
                              {"choices", {}, Form::each_choice, ""}};

Scene canary(const std::vector<std::string>& set) {
  return load_scene(cases_directory() / "canary.toml", set);
}

// Each part changes the one key that its name says, and nothing else.
TEST(Parts, EachChoiceIsAsTheSceneHasItNot) {
  for (const case_file::PresetEntry& preset : case_file::presets()) {
    const std::vector<std::string> own{"model.preset=" + preset.word};
    const Scene scene = canary(own);
    const std::vector<Part> all = parts_for(parts, scene);
    EXPECT_EQ(all.front().name, "no LES");
    for (const case_file::Choice& choice : case_file::choices()) {
      const auto changes = [&](const Part& part) { return part.set.front().starts_with(choice.key + "="); };
      EXPECT_EQ(std::ranges::any_of(all, changes),
                case_file::set_by_a_preset(choice.key) || choice.key.starts_with("model."))
          << choice.key;
    }
    for (const Part& part : all) {
      ASSERT_EQ(part.set.size(), 1u) << part.name;
      std::vector<std::string> set = own;
      set.push_back(part.set.front());
      EXPECT_NE(canary(set).resolved, scene.resolved) << part.name << " changes nothing";
    }
  }
}

TEST(Parts, OfThePapersModelAddWhatTheSourcedOneTakesOut) {
  const auto has = [](const std::vector<std::string>& set, const std::string& name) {
    return std::ranges::any_of(parts_for(parts, canary(set)), [&](const Part& p) { return p.name == name; });
  };
  EXPECT_TRUE(has({"model.preset=paper"}, "friction_law = inertial"));
  EXPECT_FALSE(has({"model.preset=paper"}, "friction_law = constant"));
  EXPECT_TRUE(has({"model.preset=paper", "model.friction_law=inertial"}, "friction_law = constant"));
}

TEST(Parts, EachChoiceAloneHasNoOverrides) {
  EXPECT_THROW(overrides_of(parts[1], canary({})), std::invalid_argument);
}

}  // namespace
}  // namespace granvof::compare
