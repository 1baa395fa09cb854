// Values as canonical TOML text; numbers are the shortest text that reads back to the same number.
#pragma once

#include <string>
#include <vector>

namespace granvof::case_file {

inline std::string toml_text(bool b) {
  return b ? "true" : "false";
}
std::string toml_text(double x);
inline std::string toml_text(int i) {
  return std::to_string(i);
}
std::string toml_text(const std::string& s);

template <class T>
std::string toml_text(const std::vector<T>& list) {
  std::string text = "[";
  for (const T& item : list) text += (text.size() > 1 ? ", " : "") + toml_text(item);
  return text + "]";
}

}  // namespace granvof::case_file
