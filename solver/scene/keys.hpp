// The keys of a case: the one place that says for each its name, type, unit, range, default and meaning.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/case_text.hpp"
#include "solver/scene/draft.hpp"
#include "solver/scene/parts.hpp"

namespace granvof::case_file {

// What a key is about decides which hash of the scene it enters.
enum class Scope {
  unset,      // while the table is built: the scope of its [table]
  label,      // names: in no hash
  setup,      // geometry, materials, walls: in both hashes
  model,      // the continuum's closures: in Scene::hash
  reference,  // settings of the DEM-VOF reference: in both hashes
  run         // grid, numerics, length, output: in no hash
};

struct Table {
  std::string name;
  Scope scope = Scope::setup;
  const Part* part = nullptr;  // whose its keys are that name no part themselves; none: each names its own
  bool optional = false;       // a case may leave it out; its required keys are required only where it stands
  std::string help;
  bool many = false;  // may stand as [[name]], as often as there are such things: its keys are lists
};

inline constexpr std::string_view unit_of_times = "time.unit";  // unit of a key whose unit is another key

struct Key {
  std::string name;       // "solid.friction"
  std::string type;       // "number", "integer", ...
  std::string unit;       // "m", as units.hpp reads it, or unit_of_times; "-" for a pure number, "" for none
  std::string allowed;    // "a number >= 0"
  std::string otherwise;  // what holds where the key is absent; empty: the key is required
  std::string help;
  Scope scope = Scope::unset;
  const Part* part = nullptr;  // whose key it is; while the table is built none: that of its [table]
  bool documented = true;      // false for the sides after the first: they share one row
  // Value at which the key stays out of the hashes, as canonical TOML. For a key that came when there were
  // records: a case that does not use it is the case that was recorded. It is stated for good, not taken from
  // the default: where that changes, cases of the old one keep their hash and those of the new one get
  // another. Empty: the key is in the hash at any value; one without a value is in none.
  std::string unhashed = {};
  std::vector<std::string> words = {};  // of a key that takes nothing but these, as canonical TOML

  // Takes the value into the draft; false where type or range do not fit.
  std::function<bool(Draft&, const Value&)> set;
  // The value as canonical TOML; empty where there is none.
  std::function<std::string(const Draft&)> get;

  bool required() const { return otherwise.empty(); }
  std::string table() const { return name.substr(0, name.find('.')); }
};

const std::vector<Table>& tables();
const std::vector<Key>& keys();
const Key* find_key(std::string_view name);
const Table* find_table(std::string_view name);

// scene.name is the name of a file and of a folder [bytes].
inline constexpr std::size_t longest_scene_name = 100;

// The known key nearest to an unknown one, by edit distance; empty where none is near.
std::string nearest_key(std::string_view name);

}  // namespace granvof::case_file
