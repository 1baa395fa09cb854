// Named presets of the model, `[model] preset = "..."`: the one place that says which choices there are
// beside the paper's model, what each preset makes of them and why, and which preset holds where a case names
// none.
//
// A preset gives way to single keys: a key that a case, its bases or an override state holds, in whichever
// layer it stands; of presets the last holds. But a key that only repeats what the preset beside it (in the
// same file, or among the overrides) sets states nothing of its own, and gives way to a preset of a later
// layer: so a resolved case, which states all, takes another preset as the case it was made of does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/scene/case_text.hpp"

namespace granvof {
struct Scene;
}

namespace granvof::case_file {

struct Draft;

enum class Preset { advised, paper, sourced };

inline constexpr Preset default_preset = Preset::advised;

struct PresetEntry {
  Preset preset;
  std::string word;   // as in a case
  std::string about;  // one line
};

// One key that presets decide on; where a preset has no value, the key's initial value holds: the paper's.
struct Choice {
  std::string key;  // of [model], [numerics] or [contact]
  std::optional<Value> advised = {}, sourced = {};
  std::string reason;  // what the choice is for, and its source

  const std::optional<Value>& value(Preset preset) const;
};

const std::vector<PresetEntry>& presets();
const std::vector<Choice>& choices();

std::string word_of(Preset preset);

// The choice on a key; none where no preset decides on it.
const Choice* find_choice(std::string_view key);
// Whether any preset sets the key.
bool set_by_a_preset(std::string_view key);

// The value of a choice under a preset, as canonical TOML.
std::string text_under(const Choice& choice, Preset preset);

// Sets what the draft's preset sets.
void apply_preset(Draft& draft);

// Whether this entry of the text only repeats the preset beside it, and a later layer names another preset.
bool gives_way_to_a_preset(const CaseText& text, const std::string& key);

// A choice as a scene has it, and what else there is: what any preset sets, the paper's included, and of a
// key of [model] all of its words. Canonical TOML.
struct ChoiceOfScene {
  std::string key, now;
  std::vector<std::string> others;
  std::string reason;
};
std::vector<ChoiceOfScene> choices_of(const Scene& scene);

// What the presets set, as Markdown.
std::string presets_reference();

}  // namespace granvof::case_file
