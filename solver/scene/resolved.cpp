#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::case_file {
namespace {

// FNV-1a, 64 bits (Fowler, Noll & Vo): the same on every machine.
std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

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

std::string hash_of(const Draft& draft, const std::vector<Scope>& scopes) {
  std::string text;
  for (const Key& key : keys()) {
    if (!draft.tables.contains(key.table()) || !std::ranges::count(scopes, key.scope)) continue;
    const std::string value = key.get(draft);
    if (!value.empty() && value != key.unhashed) text += fmt::format("{}={}\n", key.name, value);
  }
  return fmt::format("{:016x}", fnv1a(text));
}

}  // namespace granvof::case_file
