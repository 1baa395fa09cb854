#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "solver/scene/complete.hpp"
#include "solver/scene/fnv1a.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::case_file {

std::string resolved_text(const Draft& draft) {
  std::string text;
  for (const Table& table : tables()) {
    if (!draft.tables.contains(table.name)) continue;
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table.name);
    for (const Key& key : keys()) {
      if (key.table() != table.name) continue;
      const std::string value = key.get(draft);
      if (value.empty()) continue;
      text += fmt::format("{} = {}", key.name.substr(table.name.size() + 1), value);
      const Choice* choice = find_choice(key.name);
      if (choice && text_under(*choice, draft.preset) != value)
        text += fmt::format("  # the preset has {}", text_under(*choice, draft.preset));
      text += '\n';
    }
  }
  return text;
}

std::string hash_of(const Draft& draft, const std::vector<Scope>& scopes, const std::vector<Key>& of) {
  std::string text;
  for (const Key& key : of) {
    if (!draft.tables.contains(key.table()) || !std::ranges::count(scopes, key.scope)) continue;
    const std::string value = key.get(draft);
    if (!value.empty() && value != key.unhashed) text += fmt::format("{}={}\n", key.name, value);
  }
  return fmt::format("{:016x}", fnv1a(text));
}

}  // namespace granvof::case_file
