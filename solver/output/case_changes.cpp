#include "solver/output/case_changes.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace granvof {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

Entries entries_of(std::string_view text) {
  Entries entries;
  std::string table;
  while (!text.empty()) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto equals = line.find(" = ");
    if (line.starts_with('[') && line.ends_with(']'))
      table = line.substr(1, line.size() - 2);
    else if (equals != std::string_view::npos)
      entries.emplace_back(fmt::format("{}.{}", table, line.substr(0, equals)), line.substr(equals + 3));
  }
  return entries;
}

std::string value_of(const Entries& entries, const std::string& key) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == key; });
  return found == entries.end() ? std::string() : found->second;
}

}  // namespace

std::vector<CaseChange> case_changes(std::string_view before, std::string_view now) {
  const Entries old_entries = entries_of(before), new_entries = entries_of(now);
  std::vector<CaseChange> changes;
  for (const auto& [key, is] : new_entries)
    if (const std::string was = value_of(old_entries, key); was != is) changes.push_back({key, was, is});
  for (const auto& [key, was] : old_entries)
    if (value_of(new_entries, key).empty()) changes.push_back({key, was, ""});
  return changes;
}

bool may_change_on_resume(std::string_view key) {
  return key == "time.end" || key.starts_with("output.");
}

std::string change_text(const CaseChange& change) {
  const auto shown = [](const std::string& value) {
    return value.empty() ? std::string("not given") : value;
  };
  return fmt::format("{} was {}, is {}", change.key, shown(change.was), shown(change.is));
}

}  // namespace granvof
