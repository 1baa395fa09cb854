// Names that files and people give and that become part of a path: of runs, cases and records.
#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace granvof::compare {

// Letters, digits and "-_.", the first a letter or digit: neither "..", nor a path, nor an option.
inline bool is_name(std::string_view text) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return !text.empty() && text.size() <= 200 && letter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [&](char c) { return letter(c) || c == '-' || c == '_' || c == '.'; });
}

}  // namespace granvof::compare
