// Named presets of the model: what they set, and which value of a key wins. What a preset holds is asked of
// its table, so that an entry may change without a test.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"
#include "solver/tests/scene/case_fixture.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::case_file {
namespace {

namespace fs = std::filesystem;

// The small case without its own preset.
std::string bare() {
  std::string text(test::small_case);
  const std::string own = "[model]\npreset = \"paper\"\n";
  const auto at = text.find(own);
  EXPECT_NE(at, std::string::npos);
  return text.erase(at, own.size());
}

// The line of a resolved case that states a key, its comment included.
std::string line_of(const std::string& resolved, const std::string& name) {
  const auto table = resolved.find("[" + name.substr(0, name.find('.')) + "]");
  const auto begin = resolved.find("\n" + name.substr(name.find('.') + 1) + " = ", table) + 1;
  return resolved.substr(begin, resolved.find('\n', begin) - begin);
}

// A choice that `preset` makes other than the paper, and the word or switch it sets.
const Choice& a_choice_of(Preset preset) {
  const auto found =
      std::ranges::find_if(choices(), [&](const Choice& c) { return c.value(preset).has_value(); });
  EXPECT_NE(found, choices().end()) << "a preset that is the paper's";
  return *found;
}

std::string paper_of(const Choice& choice) {
  return find_key(choice.key)->get(Draft{});
}

TEST(Presets, AreWhatTheKeySays) {
  const Key* key = find_key("model.preset");
  ASSERT_NE(key, nullptr);
  for (const PresetEntry& preset : presets()) {
    EXPECT_NE(key->allowed.find('"' + preset.word + '"'), std::string::npos) << preset.word;
    EXPECT_FALSE(preset.about.empty());
  }
  EXPECT_EQ(key->otherwise, '"' + word_of(default_preset) + '"');
  EXPECT_EQ(word_of(default_preset), "advised");
}

TEST(Presets, SetKeysThatExistToValuesTheyTakeAndOthersThanThePapers) {
  std::set<std::string> names;
  for (const Choice& choice : choices()) {
    const Key* key = find_key(choice.key);
    ASSERT_NE(key, nullptr) << choice.key;
    EXPECT_TRUE(names.insert(choice.key).second) << choice.key << " has two rows";
    EXPECT_GT(choice.reason.size(), 10U) << choice.key;
    EXPECT_FALSE(choice.value(Preset::paper)) << choice.key;
    for (const PresetEntry& preset : presets()) {
      const auto& value = choice.value(preset.preset);
      Draft draft;
      if (!value) continue;
      EXPECT_TRUE(key->set(draft, *value)) << choice.key;
      EXPECT_NE(key->get(draft), paper_of(choice)) << choice.key << ": leave it out, it is the paper's";
    }
  }
}

// The parts of the paper's own model, which are switched off one at a time only to see what they are worth.
const std::set<std::string> parts_of_the_paper{"model.drag",
                                               "model.les",
                                               "model.pressure_work",
                                               "model.granular_temperature",
                                               "model.colour",
                                               "model.dilatancy_pressure",
                                               "model.contact_friction",
                                               "model.kinetic_viscosity"};

// A new key of [model], and a new word key of [numerics], is to be decided on in the table of presets.
TEST(Presets, TheirTableHasEveryOptionalChoice) {
  for (const Key& key : keys()) {
    const bool numerics = key.table() == "numerics" && (key.type == "word" || key.type == "true or false");
    if ((key.table() != "model" && !numerics) || key.name == "model.preset") continue;
    const bool listed =
        std::ranges::any_of(choices(), [&](const Choice& choice) { return choice.key == key.name; });
    EXPECT_NE(listed, parts_of_the_paper.contains(key.name)) << key.name;
  }
}

TEST(Presets, WithoutOneTheDefaultHolds) {
  const Scene without = parse_scene(bare(), "bare.toml");
  const Scene named =
      parse_scene(bare(), "bare.toml", std::vector<std::string>{"model.preset=" + word_of(default_preset)});
  EXPECT_EQ(without, named);
  EXPECT_NE(without.resolved, test::small().resolved);
}

TEST(Presets, ThePapersIsTheModelWithoutAnyChoice) {
  const Scene paper = parse_scene(bare(), "bare.toml", std::vector<std::string>{"model.preset=paper"});
  EXPECT_EQ(paper.model, Model{});
  EXPECT_EQ(paper.numerics, Numerics{});
  EXPECT_EQ(paper.contact, Contact{});
}

TEST(Presets, SetTheirKeysInTheSceneAndStateThem) {
  for (const PresetEntry& preset : presets()) {
    const Scene scene = test::small({"model.preset=" + preset.word});
    EXPECT_EQ(line_of(scene.resolved, "model.preset"), "preset = \"" + preset.word + '"');
    for (const Choice& choice : choices()) {
      Draft draft;
      const Key& key = *find_key(choice.key);
      if (const auto& value = choice.value(preset.preset)) key.set(draft, *value);
      EXPECT_EQ(line_of(scene.resolved, choice.key),
                choice.key.substr(choice.key.find('.') + 1) + " = " + key.get(draft));
    }
  }
}

// To the scene, a preset is the keys it sets: the same list of overrides on the paper's gives the same hash.
TEST(Presets, AreInTheHashByWhatTheySet) {
  for (const PresetEntry& preset : presets()) {
    std::vector<std::string> single;
    for (const Choice& choice : choices()) {
      Draft draft;
      if (const auto& value = choice.value(preset.preset)) {
        find_key(choice.key)->set(draft, *value);
        single.push_back(choice.key + "=" + find_key(choice.key)->get(draft));
      }
    }
    const Scene by_name = test::small({"model.preset=" + preset.word});
    const Scene by_keys = test::small(single);
    EXPECT_EQ(by_name.hash, by_keys.hash) << preset.word;
    EXPECT_EQ(by_name.model, by_keys.model) << preset.word;
    EXPECT_EQ(by_name.numerics, by_keys.numerics) << preset.word;
    EXPECT_EQ(by_name.contact, by_keys.contact) << preset.word;
    EXPECT_EQ(by_name.reference_hash, test::small().reference_hash) << "a record does not depend on it";
  }
  EXPECT_NE(test::small({"model.preset=sourced"}).hash, test::small().hash);
}

TEST(Presets, AnUnknownOneIsRefusedWithTheirNames) {
  const std::string message = test::refusal_of(test::small_case, {"model.preset=papre"});
  EXPECT_NE(message.find("--set: model.preset: got \"papre\", allowed: "), std::string::npos) << message;
  for (const PresetEntry& preset : presets())
    EXPECT_NE(message.find('"' + preset.word + '"'), std::string::npos) << message;
  EXPECT_NE(test::refusal_of(test::small_case, {"model.preset=true"}).find("model.preset: got true"),
            std::string::npos);
}

TEST(Presets, ThePageOfKeysHasThem) {
  const std::string page = keys_reference();
  for (const PresetEntry& preset : presets()) EXPECT_NE(page.find(preset.about), std::string::npos);
  for (const Choice& choice : choices())
    EXPECT_NE(page.find("| " + choice.key + " |"), std::string::npos) << choice.key;
}

// --- layers ---------------------------------------------------------------------------------------------

class PresetLayers : public ::testing::Test {
 protected:
  // `text` is put into [model], `numerics` into [numerics], of a case based on the one before.
  Scene last(const std::vector<std::string>& layers, const std::vector<std::string>& overrides = {}) {
    std::string base = "bare.toml";
    std::ofstream(temporary_.path() / base) << bare();
    int n = 0;
    for (const std::string& layer : layers) {
      const std::string name = fmt::format("layer{}", ++n);
      std::ofstream(temporary_.path() / (name + ".toml"))
          << fmt::format("base = \"{}\"\n[scene]\nname = \"{}\"\n{}\n", base, name, layer);
      base = name + ".toml";
    }
    if (layers.empty()) return parse_scene(bare(), "bare.toml", overrides);
    return load_scene(temporary_.path() / base, overrides);
  }

  static std::string preset(Preset preset) { return "[model]\npreset = \"" + word_of(preset) + "\"\n"; }
  // Whether the scene has the choice as this preset has it.
  static bool has(const Scene& scene, const Choice& choice, Preset preset) {
    Draft draft;
    if (const auto& value = choice.value(preset)) find_key(choice.key)->set(draft, *value);
    const std::string line = line_of(scene.resolved, choice.key);
    return line.substr(line.find("= ") + 2, line.find("  #") - line.find("= ") - 2) ==
           find_key(choice.key)->get(draft);
  }
  // "model.x" as the paper has it, as a line of a case: dotted, so that it needs no table of its own.
  static std::string as_the_paper(const Choice& choice) { return choice.key + "=" + paper_of(choice); }

 private:
  test::TemporaryDirectory temporary_;
};

TEST_F(PresetLayers, ALaterPresetReplacesAnEarlierOneWholly) {
  const Choice& choice = a_choice_of(Preset::sourced);
  EXPECT_TRUE(has(last({preset(Preset::paper), preset(Preset::sourced)}), choice, Preset::sourced));
  EXPECT_TRUE(has(last({preset(Preset::sourced), preset(Preset::paper)}), choice, Preset::paper));
  EXPECT_TRUE(has(last({preset(Preset::paper)}, {"model.preset=sourced"}), choice, Preset::sourced));
  EXPECT_TRUE(has(last({preset(Preset::sourced)}, {"model.preset=paper"}), choice, Preset::paper));
}

TEST_F(PresetLayers, ABasesPresetIsInherited) {
  EXPECT_TRUE(has(last({preset(Preset::sourced), ""}), a_choice_of(Preset::sourced), Preset::sourced));
}

TEST_F(PresetLayers, ASingleKeyIsOnTopInWhicheverLayerItStands) {
  const Choice& choice = a_choice_of(Preset::sourced);
  const std::string key = as_the_paper(choice);
  const std::string line =
      "[" + choice.key.substr(0, choice.key.find('.')) + "]\n" + key.substr(key.find('.') + 1) + "\n";
  for (const Scene& scene : {last({preset(Preset::sourced)}, {key}), last({}, {"model.preset=sourced", key}),
                             last({}, {key, "model.preset=sourced"}), last({line, preset(Preset::sourced)}),
                             last({preset(Preset::sourced), line}), last({line}, {"model.preset=sourced"})}) {
    EXPECT_TRUE(has(scene, choice, Preset::paper)) << scene.resolved;
    // and it is said that this is not what the preset has
    EXPECT_NE(line_of(scene.resolved, choice.key).find("  # the preset has "), std::string::npos);
  }
}

// As in a resolved case, which states all that follows from its preset.
TEST_F(PresetLayers, AKeyThatOnlyRepeatsThePresetBesideItGivesWayToALaterPreset) {
  const Choice& choice = a_choice_of(Preset::sourced);
  const std::string repeated = as_the_paper(choice);
  const std::string table = choice.key.substr(0, choice.key.find('.'));
  const std::string own = table == "model" ? "" : "[" + table + "]\n";
  const std::string both = preset(Preset::paper) + own + repeated.substr(repeated.find('.') + 1) + "\n";
  EXPECT_TRUE(has(last({both, preset(Preset::sourced)}), choice, Preset::sourced));
  EXPECT_TRUE(has(last({both}, {"model.preset=sourced"}), choice, Preset::sourced));
  EXPECT_TRUE(has(last({both, ""}), choice, Preset::paper));
}

TEST_F(PresetLayers, AResolvedCaseTakesAPresetAsTheCaseItself) {
  for (const PresetEntry& own : presets())
    for (const PresetEntry& later : presets()) {
      const std::vector<std::string> at_first{"model.preset=" + own.word, "numerics.solid_flux=limited"};
      const Scene first = last({}, at_first);
      Scene again = parse_scene(first.resolved, "bare.toml");
      EXPECT_EQ(first, again) << first.resolved;
      const Scene changed =
          parse_scene(first.resolved, "bare.toml", std::vector<std::string>{"model.preset=" + later.word});
      EXPECT_EQ(changed, last({}, {"numerics.solid_flux=limited", "model.preset=" + later.word}));
    }
}

}  // namespace
}  // namespace granvof::case_file
