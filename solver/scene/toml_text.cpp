#include "solver/scene/toml_text.hpp"

#include <fmt/format.h>

namespace granvof::case_file {

std::string toml_text(double x) {
  return fmt::format("{}", x == 0.0 ? 0.0 : x);
}  // never -0

std::string toml_text(const std::string& s) {
  std::string text = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') {
      text += fmt::format("\\{}", c);
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      text += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  return text + '"';
}

}  // namespace granvof::case_file
