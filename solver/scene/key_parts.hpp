// How deep the keys of a TOML text go, seen before a parser follows them: it descends once for each part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace granvof::case_file {

// Of a dotted key, or of a table's header; no file of this project has more than four.
inline constexpr std::size_t most_key_parts = 64;

struct TextPlace {
  std::int64_t line = 1, column = 1;
};

// Where a key of the text has more parts than that; none where none has. Text that is no TOML is no matter.
std::optional<TextPlace> overlong_key(std::string_view text);

}  // namespace granvof::case_file
