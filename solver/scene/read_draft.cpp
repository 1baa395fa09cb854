#include <fmt/format.h>

#include "solver/scene/complete.hpp"
#include "solver/scene/faults.hpp"
#include "solver/scene/key_types.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"
#include "solver/scene/printable.hpp"

namespace granvof::case_file {
namespace {

constexpr std::size_t longest_name = 80;

void append(std::string& list, const std::string& name) {
  list += (list.empty() ? "" : ", ") + name;
}

std::string keys_of(const std::string& table) {
  std::string names;
  for (const Key& key : keys()) {
    if (key.documented && key.table() == table) append(names, key.name.substr(table.size() + 1));
  }
  return names;
}

Fault unknown(const std::string& path, const Entry& entry) {
  const std::string table = path.substr(0, path.find('.'));
  const std::string name = printable(path, longest_name);
  const Table* known = find_table(table);
  if (known && table == path) {
    return {path, entry.where,
            fmt::format("{}: got {}, allowed: a table [{}]{}", name, entry.shown, name,
                        known->optional ? ", or false in a case that is based on one with it" : "")};
  }
  const std::string nearest = nearest_key(path);
  std::string help;
  if (!nearest.empty()) {
    help = "did you mean " + nearest + "?";
  } else if (known) {
    help = fmt::format("allowed in [{}]: {}", table, keys_of(table));
  } else {
    std::string names;
    for (const Table& t : tables()) append(names, t.name);
    help = "allowed tables: " + names;
  }
  // What was meant is not looked at any further: it would be missed, or taken at its default.
  return {nearest.empty() ? path : nearest, entry.where,
          fmt::format("{}: unknown key (got {}), {}", name, entry.shown, help)};
}

// Each entry of an unknown table is a fault of its own.
bool has_entries(const CaseText& text, const std::string& table) {
  const auto next = text.entries.lower_bound(table + ".");
  return next != text.entries.end() && next->first.starts_with(table + ".");
}

std::string allowed_of(const Key& key, const Value& value) {
  if (!beyond_doubles(value)) return key.allowed;
  return fmt::format("{}, of a size within [{:g}, {:g}]", key.allowed, smallest_size, largest_size);
}

}  // namespace

Draft read_draft(const CaseText& text, Faults& faults) {
  Draft draft;
  for (const auto& [name, where] : text.tables) {
    if (find_table(name)) {
      draft.tables.insert(name);
    } else if (!has_entries(text, name)) {
      faults.add(unknown(name, {.value = {}, .shown = "a table", .where = where}));
    }
  }
  for (const Table& table : tables()) {
    if (!table.optional) draft.tables.insert(table.name);
  }
  const auto take = [&](const std::string& path, const Entry& entry) {
    const Key* key = find_key(path);
    if (!key) {
      faults.add(unknown(path, entry));
    } else if (!key->set(draft, entry.value)) {
      faults.add(fault_of(text, draft, path, allowed_of(*key, entry.value)));
    }
  };
  // The preset comes first: single keys go on top of it.
  const auto preset = text.entries.find("model.preset");
  if (preset != text.entries.end()) take(preset->first, preset->second);
  apply_preset(draft);
  for (auto entry = text.entries.begin(); entry != text.entries.end(); ++entry) {
    if (entry != preset && !gives_way_to_a_preset(text, entry->first)) take(entry->first, entry->second);
  }
  for (const Key& key : keys()) {
    if (!key.required() || !draft.tables.contains(key.table()) || text.entries.contains(key.name)) continue;
    if (!faults.touch(key.name)) {
      faults.add(fault_of(text, draft, key.name, key.allowed + " (the key is required)"));
    }
  }
  return draft;
}

}  // namespace granvof::case_file
