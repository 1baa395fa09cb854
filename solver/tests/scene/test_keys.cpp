// The table of keys itself.
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/scene/keys.hpp"
#include "solver/scene/load_scene.hpp"

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

TEST(Keys, ADefaultIsAllowed) {
  Draft draft;
  EXPECT_TRUE(find_key("numerics.cfl")->set(draft, draft.scene.numerics.cfl));
  EXPECT_FALSE(find_key("numerics.cfl")->set(draft, -draft.scene.numerics.cfl));
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
