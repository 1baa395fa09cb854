#include "solver/scene/faults.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/keys.hpp"

namespace granvof::case_file {
namespace {

constexpr std::size_t most_lines = 20;
constexpr std::size_t longest_message =
    1900;  // bytes, for a terminal; the first line is said however long it is

bool within(std::string_view key, std::string_view table) {
  return key == table || (key.starts_with(table) && key[table.size()] == '.');
}

}  // namespace

bool Faults::touch(std::string_view key) const {
  return std::ranges::any_of(list_, [&](const Fault& f) { return within(key, f.key) || within(f.key, key); });
}

void Faults::throw_if_any() const {
  if (list_.empty()) return;
  std::vector<Fault> sorted = list_;
  std::ranges::stable_sort(sorted, {}, &Fault::place);
  std::string lines;
  std::size_t said = 0;
  for (; said < std::min(sorted.size(), most_lines); ++said) {
    const std::string line =
        fmt::format("{}{}: {}", said == 0 ? "" : "\n", sorted[said].place.text(), sorted[said].message);
    if (said > 0 && lines.size() + line.size() > longest_message) break;
    lines += line;
  }
  if (said < sorted.size()) lines += fmt::format("\nand {} more faults", sorted.size() - said);
  throw CaseError(lines);
}

Fault fault_of(const CaseText& text, const Draft& draft, const std::string& name,
               const std::string& allowed) {
  const auto entry = text.entries.find(name);
  if (entry != text.entries.end()) {
    return {name, entry->second.where,
            fmt::format("{}: got {}, allowed: {}", name, entry->second.shown, allowed)};
  }
  const Key* key = find_key(name);
  const std::string value = key && !key->required() ? key->get(draft) : "";
  return {name, text.place_of(name.substr(0, name.find('.'))),
          fmt::format("{}: got {}, allowed: {}", name, value.empty() ? "nothing" : value + " (the default)",
                      allowed)};
}

}  // namespace granvof::case_file
