// The table of keys itself.
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/case_text.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/key_types.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::case_file {
namespace {

TEST(Keys, AreDeclaredOnceAndInFull) {
  std::set<std::string> names;
  for (const Key& key : keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_NE(find_table(key.table()), nullptr) << key.name;
    EXPECT_NE(key.scope, Scope::unset) << key.name;
    for (const std::string& text : {key.type, key.allowed, key.help}) EXPECT_FALSE(text.empty()) << key.name;
  }
}

TEST(Keys, StandTogetherByTable) {
  std::set<std::string> finished;
  std::string current;
  for (const Key& key : keys()) {
    if (key.table() == current) continue;
    EXPECT_TRUE(finished.insert(key.table()).second) << key.name << " stands apart from its table";
    current = key.table();
  }
}

// What a case file says of a key in that text; nothing where the text is a sentence.
std::optional<Value> value_of(const Key& key, const std::string& text) {
  try {
    return read_case_text(key.name + " = " + text, "default", {}).entries.at(key.name).value;
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

// The key takes the value, and gives back that text.
void expect_taken(const Key& key, const std::string& text, Draft& draft) {
  const auto value = value_of(key, text);
  ASSERT_TRUE(value) << key.name << ": " << text;
  EXPECT_TRUE(key.set(draft, *value)) << key.name << ": " << text << ", allowed: " << key.allowed;
  EXPECT_EQ(key.get(draft), text) << key.name;
}

// Of each key that has one, the presets' included. What depends on other keys is stated as a sentence.
TEST(Keys, ADefaultIsAllowed) {
  std::size_t values = 0;
  for (const Key& key : keys()) {
    std::vector<std::string> defaults;
    if (const Choice* choice = find_choice(key.name))
      for (const PresetEntry& entry : presets()) defaults.push_back(text_under(*choice, entry.preset));
    else if (!key.required() && (key.otherwise == key.get(Draft{}) || value_of(key, key.otherwise)))
      defaults.push_back(key.otherwise);
    for (const std::string& text : defaults) {
      Draft draft;
      expect_taken(key, text, draft);
      ++values;
    }
  }
  EXPECT_GT(values, 100U);
  Draft draft;
  EXPECT_FALSE(find_key("numerics.cfl")->set(draft, -draft.scene.numerics.cfl));
}

// Another value that a key takes.
std::string another(const Key& key, const std::string& than) {
  std::vector<std::string> tried = key.words;
  for (const char* number : {"0.6", "0.5", "2", "1"}) tried.emplace_back(number);
  for (const std::string& text : tried) {
    Draft draft;
    const auto value = value_of(key, text);
    if (value && key.set(draft, *value) && key.get(draft) != than) return key.get(draft);
  }
  return "";
}

// Who changes the default of a key that came later changes what a case without it means, and the hash of that
// alone: a case that says the old value is the case that was recorded.
TEST(Keys, ALaterDefaultMovesNoHashButItsOwn) {
  const std::vector<Scope> scopes{Scope::setup, Scope::model, Scope::reference};
  std::size_t pinned = 0;
  for (std::size_t i = 0; i < keys().size(); ++i) {
    const Key& key = keys()[i];
    if (key.unhashed.empty()) continue;
    ++pinned;
    std::vector<Key> before = keys(), later = keys();
    before.erase(before.begin() + static_cast<std::ptrdiff_t>(i));
    const std::string now = another(key, key.unhashed);
    ASSERT_NE(now, "") << key.name;
    later[i] = came_later(otherwise(key, now), key.unhashed);
    Draft stated, in_force;
    stated.tables = in_force.tables = {key.table()};
    expect_taken(key, key.unhashed, stated);
    expect_taken(key, now, in_force);
    EXPECT_EQ(hash_of(stated, scopes, later), hash_of(stated, scopes)) << key.name;
    EXPECT_EQ(hash_of(stated, scopes), hash_of(stated, scopes, before)) << key.name;
    EXPECT_NE(hash_of(in_force, scopes, later), hash_of(stated, scopes)) << key.name;
  }
  EXPECT_GE(pinned, 22U);
}

// Whatever the defaults are by now: what was not there when the records were made, was not used.
TEST(Keys, AKeyWithoutAValueIsInNoHash) {
  for (const Key& key : keys()) {
    if (key.table() != "walls") continue;
    EXPECT_EQ(key.unhashed, "") << key.name;
    EXPECT_EQ(key.get(Draft{}), "") << key.name;
  }
}

// A choice of the model takes the words of its list of closures, in their order.
template <typename List>
std::vector<std::string> words_of() {
  std::vector<std::string> words;
  for (const closures::ClosureFacts& facts : List::facts)
    words.push_back('"' + std::string(facts.word) + '"');
  return words;
}

TEST(Keys, AChoiceTakesTheWordsOfItsList) {
  EXPECT_EQ(find_key("model.drag_law")->words, words_of<closures::DragLaws>());
  EXPECT_EQ(find_key("model.friction_law")->words, words_of<closures::FrictionLaws>());
  EXPECT_EQ(find_key("model.radial_distribution")->words, words_of<closures::RadialDistributions>());
  EXPECT_EQ(find_key("model.kinetic_transport")->words, words_of<closures::KineticTransports>());
  EXPECT_EQ(find_key("model.packing")->words, words_of<closures::Packings>());
  EXPECT_EQ(find_key("model.critical_packing")->words, words_of<closures::CriticalPackings>());
  EXPECT_EQ(find_key("model.granular_temperature")->words, words_of<closures::TemperatureModels>());
}

TEST(Keys, NearestIsFoundByEditDistance) {
  EXPECT_EQ(nearest_key("solid.denisty"), "solid.density");
  EXPECT_EQ(nearest_key("numeric.cfl"), "numerics.cfl");
  EXPECT_EQ(nearest_key("weather.temperature_outside"), "");
}

TEST(Keys, TheReferencePageHasEveryDocumentedKey) {
  const std::string page = keys_reference();
  for (const Key& key : keys()) {
    if (!key.documented) continue;
    EXPECT_NE(page.find(key.help), std::string::npos) << key.name;
  }
  for (const Table& table : tables()) EXPECT_NE(page.find("## [" + table.name + "]"), std::string::npos);
}

}  // namespace
}  // namespace granvof::case_file
