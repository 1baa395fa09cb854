#include <algorithm>

#include <fmt/format.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::case_file {
namespace {

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

[[noreturn]] void refuse_unknown(const std::string& path, const Entry& entry) {
  const std::string table = path.substr(0, path.find('.'));
  const Table* known = find_table(table);
  if (known && table == path) {
    throw CaseError(fmt::format("{}: {}: got {}, allowed: a table [{}]{}", entry.where, path, entry.shown,
                                path,
                                known->optional ? ", or false in a case that is based on one with it" : ""));
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
  throw CaseError(fmt::format("{}: {}: unknown key (got {}), {}", entry.where, path, entry.shown, help));
}

}  // namespace

void refuse(const CaseText& text, const Draft& draft, const std::string& name, const std::string& allowed) {
  const auto entry = text.entries.find(name);
  if (entry != text.entries.end()) {
    throw CaseError(
        fmt::format("{}: {}: got {}, allowed: {}", entry->second.where, name, entry->second.shown, allowed));
  }
  const Key* key = find_key(name);
  const std::string value = key ? key->get(draft) : "";
  const auto table = text.tables.find(name.substr(0, name.find('.')));
  throw CaseError(fmt::format("{}: {}: got {}, allowed: {}",
                              table == text.tables.end() ? text.file : table->second, name,
                              value.empty() ? "nothing" : value + " (the default)", allowed));
}

Draft read_draft(const CaseText& text) {
  for (const auto& [path, entry] : text.entries) {
    if (!find_key(path)) refuse_unknown(path, entry);
  }
  Draft draft;
  for (const auto& [name, where] : text.tables) {
    if (!find_table(name)) refuse_unknown(name, {.value = {}, .shown = "a table", .where = where});
    draft.tables.insert(name);
  }
  for (const Table& table : tables()) {
    if (!table.optional) draft.tables.insert(table.name);
  }
  const auto take = [&](const std::string& path, const Entry& entry) {
    const Key& key = *find_key(path);
    if (!key.set(draft, entry.value)) refuse(text, draft, path, key.allowed);
  };
  if (const auto preset = text.entries.find("model.preset"); preset != text.entries.end())
    take(preset->first, preset->second);
  apply_preset(draft);
  for (const auto& [path, entry] : text.entries) {
    if (!gives_way_to_a_preset(text, path)) take(path, entry);
  }
  for (const Key& key : keys()) {
    if (!key.required() || !draft.tables.contains(key.table()) || text.entries.contains(key.name)) continue;
    const auto table = text.tables.find(key.table());
    throw CaseError(fmt::format("{}: {}: got nothing, allowed: {} (the key is required)",
                                table == text.tables.end() ? text.file : table->second, key.name,
                                key.allowed));
  }
  return draft;
}

}  // namespace granvof::case_file
