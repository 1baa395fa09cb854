#include "solver/scene/printable.hpp"

#include <fmt/format.h>

namespace granvof::case_file {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;  // 0: not UTF-8
};

// The first character of a text that is not empty (RFC 3629; overlong forms and surrogates are none).
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  char32_t code = lead & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const char32_t least = bytes == 4 ? 0x10000 : bytes == 3 ? 0x800 : 0x80;
  if (code < least || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
  return {code, bytes};
}

// C0 and C1 controls, marks of direction, line and paragraph separators, the byte order mark.
bool harmful(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || (c >= 0x200e && c <= 0x200f) ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) || c == 0xfeff;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string shown;
  for (std::string_view rest = text; !rest.empty();) {
    const Character c = first_of(rest);
    const std::size_t bytes = c.bytes == 0 ? 1 : c.bytes;
    std::string piece(rest.substr(0, bytes));
    if (c.bytes == 0) {
      piece = fmt::format("\\x{:02X}", static_cast<unsigned char>(rest.front()));
    } else if (harmful(c.code)) {
      piece = fmt::format("\\u{:04X}", static_cast<unsigned>(c.code));
    }
    if (shown.size() + piece.size() > longest) return fmt::format("{}... ({} bytes)", shown, text.size());
    shown += piece;
    rest.remove_prefix(bytes);
  }
  return shown;
}

}  // namespace granvof::case_file
