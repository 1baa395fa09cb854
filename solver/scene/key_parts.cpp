#include "solver/scene/key_parts.hpp"

#include <algorithm>

namespace granvof::case_file {
namespace {

bool is_of_a_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ' ' || c == '\t';
}

// Behind the text in quotes that begins at `at`; the end of the text, where nothing ends it.
std::size_t behind_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const auto three = [&](std::size_t i) {
    return text.size() >= i + 3 && text[i] == quote && text[i + 1] == quote && text[i + 2] == quote;
  };
  const bool block = three(at);
  for (std::size_t i = at + (block ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote && !block) {
      return i + 1;
    } else if (block && three(i)) {
      return i + 3;
    } else if (text[i] == '\n' && !block) {
      return i;
    }
  }
  return text.size();
}

TextPlace place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line = before.rfind('\n');
  const std::size_t begins = line == std::string_view::npos ? 0 : line + 1;
  return {1 + std::ranges::count(before, '\n'), static_cast<std::int64_t>(at - begins) + 1};
}

}  // namespace

std::optional<TextPlace> overlong_key(std::string_view text) {
  std::size_t parts = 1, begins = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_quotes(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    ++at;
    if (c == '.') {
      if (++parts > most_key_parts) return place_of(text, begins);
    } else if (!is_of_a_key(c)) {
      parts = 1;
      begins = at;
    }
  }
  return std::nullopt;
}

}  // namespace granvof::case_file
